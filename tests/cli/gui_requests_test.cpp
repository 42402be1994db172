// SPDX-License-Identifier: Apache-2.0
// What people ask by way of `rave gui` of a run whose manager and hosts are other processes: who is
// asked, and what waits for what.
#include <dds/dds.h>

#include <array>
#include <chrono>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "onlooker.hpp"
#include "shared_world.hpp"
#include "signed_in.hpp"

namespace rave::cli_test {
namespace {

using web::testing::RawSocket;
using Words = std::vector<std::string>;

constexpr const char* kManager = "environment manager";
constexpr const char* kServer = "GUI Server";

/// The partitions of a reader or writer.
std::set<std::string> partitions_of(const dds_qos_t* qos) {
  std::uint32_t count = 0;
  char** names = nullptr;
  if (!dds_qget_partition(qos, &count, &names)) return {};
  std::set<std::string> all;
  for (std::uint32_t i = 0; i < count; ++i) {
    all.insert(names[i]);
    dds_free(names[i]);
  }
  dds_free(names);
  return all;
}

/// One end of a topic, as its process announces it.
struct End {
  std::string process;
  std::string topic;
  std::set<std::string> partitions;
  bool reads = false;
};

/// All ends in the domain of a participant of this process.
class Ends {
 public:
  explicit Ends(dds_entity_t participant)
      : participants_(reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT)),
        writers_(reader(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION)),
        readers_(reader(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION)) {}

  [[nodiscard]] std::vector<End> all() const {
    std::map<std::array<std::uint8_t, 16>, std::string> names;
    for_each<dds_builtintopic_participant_t>(participants_, [&](const auto& sample) {
      char* name = nullptr;
      if (!dds_qget_entity_name(sample.qos, &name) || name == nullptr) return;
      names[std::to_array(sample.key.v)] = name;
      dds_free(name);
    });
    std::vector<End> ends;
    for (const bool reads : {false, true}) {
      for_each<dds_builtintopic_endpoint_t>(reads ? readers_ : writers_, [&](const auto& sample) {
        const auto name = names.find(std::to_array(sample.participant_key.v));
        if (name == names.end()) return;
        ends.push_back({name->second, sample.topic_name, partitions_of(sample.qos), reads});
      });
    }
    return ends;
  }

 private:
  static dds_entity_t reader(dds_entity_t participant, dds_entity_t topic) {
    return dds_create_reader(participant, topic, nullptr, nullptr);
  }
  template <class Sample, class Visit>
  static void for_each(dds_entity_t reader, const Visit& visit) {
    constexpr std::size_t kMost = 4096;
    std::vector<void*> samples(kMost);
    std::vector<dds_sample_info_t> infos(kMost);
    const dds_return_t count = dds_read(reader, samples.data(), infos.data(), kMost, kMost);
    for (std::size_t i = 0; i < static_cast<std::size_t>(std::max(count, 0)); ++i) {
      const bool alive = infos[i].valid_data && infos[i].instance_state == DDS_ALIVE_INSTANCE_STATE;
      if (alive) visit(*static_cast<const Sample*>(samples[i]));
    }
    if (count > 0) static_cast<void>(dds_return_loan(reader, samples.data(), count));
  }

  dds_entity_t participants_;
  dds_entity_t writers_;
  dds_entity_t readers_;
};

class GuiRequests : public SharedWorld {
 protected:
  /// Manager, two hosts and a GUI Server, each a process; a page of a super-user.
  void start_all(const std::string& scenario) {
    std::ofstream(folder_.path() / "index.html") << "<!doctype html><title>page</title>\n";
    const Words run = {"--run", run_.text(), "--duration", "100000", "--no-record", "--pace", "1x"};
    start("env", "env", scenario, run);
    start_host("one", scenario, run);
    start_host("two", scenario, run);
    Words gui = {"gui",          scenario, "--run", run_.text(), "--page",
                 folder_.path(), "--port", "0",     "--no-open"};
    for (const std::string& word : apart()) gui.push_back(word);
    gui_ = start_rave(gui, {"XDG_RUNTIME_DIR=" + folder_.path().string()}, folder("gui.log"));
    wait_until([&] { return SignedIn::is_in(content_of(folder("gui.log"))); }, "the link");
    person_.emplace(content_of(folder("gui.log")));
  }
  void TearDown() override {
    if (gui_ <= 0) return;
    ::kill(gui_, SIGKILL);
    static_cast<void>(wait_for(gui_));
  }
  /// A page that sees the run in progress.
  [[nodiscard]] RawSocket page() const {
    RawSocket page = person_->page();
    while (true) {
      const std::string time = page.text_with(R"("type":"time")");
      if (time.empty() || time.find(R"("state":"running")") != std::string::npos) return page;
    }
  }

  const bus::RunId run_ = bus::RunId::random();
  std::optional<SignedIn> person_;
  pid_t gui_ = -1;
};

TEST_F(GuiRequests, AStopDoesNotWaitForOtherRequests) {
  start_all("crowd.yaml");
  RawSocket page = this->page();
  // Each robot is a request to its host, one after the other; then as many lines of chat.
  for (int i = 0; i < 5; ++i) {
    page.send(fmt::format(
        R"({{"type":"set","request":{},"slots":[0,1,2,3,4,5,6,7,8,9],"key":"body.scale","value":"1.{}"}})",
        100 + i, i + 1));
  }
  for (int i = 0; i < 20; ++i) {
    page.send(fmt::format(R"({{"type":"say","request":{},"to":"all","text":"line {}"}})", i, i));
  }
  page.send(R"({"type":"halt","do":"stop","slots":[3]})");
  const std::string one = page.text_with(R"("to":"stop")");
  EXPECT_NE(one.find(R"("good":true)"), std::string::npos) << one;
  page.send(R"({"type":"halt","do":"stop","slots":[]})");
  const std::string all = page.text_with(R"("to":"stop")");
  EXPECT_NE(all.find(R"("good":true)"), std::string::npos) << all;
  EXPECT_NE(all.find("two: stopped"), std::string::npos) << all;
  EXPECT_EQ(page.heard().find(R"("request":104)"), std::string::npos)
      << "the last of the earlier requests is answered already, so this shows nothing";
  EXPECT_NE(page.text_with(R"("request":104)"), "");
}

TEST_F(GuiRequests, WhatTheManagerDoesGoesToItByWayOfAHost) {
  start_all("crowd.yaml");
  RawSocket page = this->page();
  page.send(R"({"type":"edit","request":1,"do":"add","name":"crate","pose":[6,6,0],"disc":0.2})");
  const std::string added = page.text_with(R"("request":1)");
  EXPECT_NE(added.find(R"("good":true)"), std::string::npos) << added;
  EXPECT_NE(added.find("added `crate` at (6, 6)"), std::string::npos) << added;
  page.send(R"({"type":"edit","request":2,"do":"add","name":"crate","pose":[7,7,0],"disc":0.2})");
  const std::string again = page.text_with(R"("request":2)");
  EXPECT_NE(again.find(R"("good":false)"), std::string::npos) << again;
  page.send(R"({"type":"set","request":3,"slots":[0],"key":"body.scale","value":"1.2"})");
  const std::string scaled = page.text_with(R"("request":3)");
  EXPECT_NE(scaled.find(R"("good":true)"), std::string::npos) << scaled;
  wait_for_line("env", "left-1: body.scale: 1.2; counts from step ");
}

TEST_F(GuiRequests, ManagerAndGuiServerHaveNoTopicInCommon) {
  auto bus = join_as_onlooker(run_, apart());
  ASSERT_TRUE(bus) << bus.error().text();
  std::array<dds_entity_t, 8> participants{};
  ASSERT_GT(dds_lookup_participant((*bus)->config().domain, participants.data(), 8), 0);
  const Ends ends(participants[0]);
  start_all("crowd.yaml");
  RawSocket page = this->page();
  page.send(
      R"({"type":"look","poses":true,"true_poses":true,"readings":[0],"parts":true,"max_hz":30})");
  page.send(R"({"type":"say","request":1,"to":"all","text":"hello"})");
  EXPECT_NE(page.text_with(R"("request":1)"), "");
  const auto of = [](const std::vector<End>& all, const std::string& process) {
    std::set<std::string> topics;
    for (const End& end : all) {
      if (end.process == process) topics.insert(end.topic);
    }
    return topics;
  };
  // Both are there, with the topics that they need.
  wait_until(
      [&] {
        const auto all = ends.all();
        const auto managed = of(all, kManager);
        const auto shown = of(all, kServer);
        return managed.contains("rave/world_step") && managed.contains("rave/request") &&
               shown.contains("rave/host_state") && shown.contains("rave/request") &&
               shown.contains("rave/command");
      },
      "the topics of both");
  for (const End& end : ends.all()) {
    if (end.process != kManager && end.process != kServer) continue;
    const std::set<std::string> expected = {"rave/" + run_.text() +
                                            (end.process == kManager ? "" : "/hosts")};
    EXPECT_EQ(end.partitions, expected) << end.process << " " << end.topic;
  }
}

}  // namespace
}  // namespace rave::cli_test
