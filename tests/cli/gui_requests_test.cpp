// SPDX-License-Identifier: Apache-2.0
// What people ask by way of `rave gui` of a run whose manager and hosts are other processes: who is
// asked, and what waits for what.
#include <dds/dds.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

#include "onlooker.hpp"
#include "shared_world.hpp"
#include "signed_in.hpp"

namespace rave::cli_test {
namespace {

using web::testing::RawSocket;
using Words = std::vector<std::string>;

constexpr const char* kManager = "environment manager";
constexpr const char* kServer = "GUI Server";

/// Pose of a robot or an obstacle: x in m, y in m, heading in rad.
using Pose = std::array<double, 3>;

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
  /// Asks the manager, from its machine, until it takes the request.
  void give(const Words& words) {
    const Words variables = {"XDG_RUNTIME_DIR=" + folder_.path().string()};
    wait_until([&] { return run_rave(words, variables).exit_code == 0; }, "a run that takes it");
  }
  /// A page that sees the run in progress.
  [[nodiscard]] RawSocket page() const {
    RawSocket page = person_->page();
    while (true) {
      const std::string time = page.text_with(R"("type":"time")");
      if (time.empty() || time.find(R"("state":"running")") != std::string::npos) return page;
    }
  }

  /// What the manager says of the obstacles.
  [[nodiscard]] std::map<std::string, Pose> managed_obstacles() const {
    std::map<std::string, Pose> all;
    const Ended list = run_rave({"edit", "list"}, {"XDG_RUNTIME_DIR=" + folder_.path().string()});
    std::istringstream lines(list.out);
    std::string line;
    std::getline(lines, line);  // How many there are.
    while (std::getline(lines, line)) {
      std::array<char, 64> name{};
      Pose pose{};
      EXPECT_EQ(std::sscanf(line.c_str(), " %*u %63s %*s (%lf, %lf) m, %lf deg", name.data(),
                            &pose[0], &pose[1], &pose[2]),
                4)
          << line;
      pose[2] *= M_PI / 180;
      all[name.data()] = pose;
    }
    return all;
  }
  /// What the GUI Server tells somebody who comes now.
  [[nodiscard]] std::map<std::string, Pose> shown_obstacles() const {
    std::map<std::string, Pose> all;
    const auto scene = nlohmann::json::parse(person_->page().text_with(R"("type":"scene")"));
    for (const auto& body : scene["bodies"]) all[body["name"]] = body["pose"].get<Pose>();
    return all;
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
  // Hosts may say that the run goes on a moment before the manager serves requests.
  give({"edit", "list"});
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

/// A frame of poses of a page, as docs/reference/gui-frames.md has it.
struct PoseFrame {
  std::uint32_t sequence = 0;
  std::uint32_t step = 0;
  double quantum_m = 0;
  std::vector<Pose> poses;
};

/// Empty: some other frame.
std::optional<PoseFrame> pose_frame(const RawSocket::Frame& frame) {
  constexpr std::size_t kHead = 48;
  constexpr std::size_t kBytesPerRobot = 14;
  constexpr unsigned kPast = 1;
  const std::string& bytes = frame.payload;
  if (frame.opcode != 2 || bytes.size() < kHead || bytes[0] != 1) return std::nullopt;
  if ((static_cast<unsigned char>(bytes[1]) & kPast) != 0) return std::nullopt;
  const auto at = [&bytes]<class T>(std::size_t offset, T value) {
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
  };
  const std::size_t n = at(20, std::uint32_t{});
  if (bytes.size() != kHead + kBytesPerRobot * n) return std::nullopt;
  PoseFrame read{at(4, std::uint32_t{}), at(16, std::uint32_t{}), at(40, float{}),
                 std::vector<Pose>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    read.poses[i] = {at(24, double{}) + read.quantum_m * at(kHead + 4 * i, std::int32_t{}),
                     at(32, double{}) + read.quantum_m * at(kHead + 4 * (n + i), std::int32_t{}),
                     2 * M_PI * at(kHead + 8 * n + 2 * i, std::uint16_t{}) / 65'536};
  }
  return read;
}

void expect_same(const PoseFrame& shown, const std::vector<Pose>& managed) {
  ASSERT_EQ(shown.poses.size(), managed.size());
  for (std::size_t r = 0; r < managed.size(); ++r) {
    EXPECT_NEAR(shown.poses[r][0], managed[r][0], shown.quantum_m) << r;
    EXPECT_NEAR(shown.poses[r][1], managed[r][1], shown.quantum_m) << r;
    EXPECT_LT(std::abs(std::remainder(shown.poses[r][2] - managed[r][2], 2 * M_PI)), 1e-4) << r;
  }
}

/// How many robots moved further than a frame can be wrong.
std::size_t moved(const std::vector<Pose>& before, const std::vector<Pose>& after) {
  std::size_t count = 0;
  for (std::size_t r = 0; r < after.size(); ++r) {
    if (std::hypot(after[r][0] - before[r][0], after[r][1] - before[r][1]) > 1e-3) ++count;
  }
  return count;
}

TEST_F(GuiRequests, ManagerAndGuiServerReportTheSameRobotsAtTheSameStep) {
  auto bus = join_as_onlooker(run_, apart());
  ASSERT_TRUE(bus) << bus.error().text();
  auto worlds = bus::Reader<bus::WorldStep>::create(**bus);
  ASSERT_TRUE(worlds) << worlds.error().text();
  start_all("crowd.yaml");
  RawSocket page = this->page();
  page.send(
      R"({"type":"look","poses":true,"true_poses":false,"readings":[],"parts":false,"max_hz":30})");
  // Reads what the page is sent until it holds; the newest poses.
  PoseFrame shown;
  const auto read_until = [&](const auto& holds) {
    while (true) {
      const auto frame = page.next();
      if (!frame) return false;  // The connection ended.
      if (const auto poses = pose_frame(*frame)) {
        shown = *poses;
        // Without an answer the server stops after two frames.
        page.send(fmt::format(R"({{"type":"ack","sequence":{}}})", shown.sequence));
      }
      if (holds(frame->payload)) return true;
    }
  };
  std::vector<Pose> before;
  for (std::uint32_t i = 1; i <= 3; ++i) {
    ASSERT_TRUE(read_until([&](const std::string&) { return shown.step > 100 * i; }));
    give({"pause"});
    // The server tells the time of a run that stands once a second, behind the last frame.
    int told = 0;
    ASSERT_TRUE(read_until([&told](const std::string& text) {
      return text.find(R"("reason":"paused")") != std::string::npos && ++told == 2;
    }));
    std::vector<Pose> managed;
    std::uint64_t step = 0;
    worlds->take([&](const bus::WorldStep& world) {
      if (world.step < step) return;
      step = world.step;
      managed.resize(world.x_m._length);
      for (std::size_t r = 0; r < managed.size(); ++r) {
        managed[r] = {world.x_m._buffer[r], world.y_m._buffer[r], world.yaw_rad._buffer[r]};
      }
    });
    // Hosts tell the number of their next step.
    EXPECT_EQ(shown.step, step + 1);
    ASSERT_EQ(managed.size(), 30U);
    expect_same(shown, managed);
    if (i > 1) {
      EXPECT_GT(moved(before, managed), managed.size() / 2);
    }
    before = managed;
    give({"resume"});
  }
}

TEST_F(GuiRequests, ManagerAndGuiServerReportTheSameObstacles) {
  start_all("crowd.yaml");
  RawSocket page = this->page();
  page.send(R"({"type":"edit","request":1,"do":"add","name":"crate","pose":[6,6,0],"disc":0.2})");
  page.send(R"({"type":"edit","request":2,"do":"add","name":"log","pose":[7,6,1],"disc":0.3})");
  page.send(R"({"type":"edit","request":3,"do":"move","name":"crate","pose":[5,6.5,0.5]})");
  page.send(R"({"type":"edit","request":4,"do":"remove","name":"log"})");
  const std::string removed = page.text_with(R"("request":4)");
  EXPECT_NE(removed.find(R"("good":true)"), std::string::npos) << removed;
  // Both say so some steps later; then they say the same.
  std::map<std::string, Pose> shown;
  std::map<std::string, Pose> managed;
  wait_until(
      [&] {
        shown = shown_obstacles();
        managed = managed_obstacles();
        return shown.size() == 2 && managed.size() == 2 && shown.contains("crate") &&
               managed.contains("crate") && shown["crate"][0] == 5 && managed["crate"][0] == 5;
      },
      "an obstacle that was added, moved and stays");
  for (const auto& [name, pose] : shown) {
    ASSERT_TRUE(managed.contains(name)) << name;
    EXPECT_NEAR(pose[0], managed[name][0], 1e-3) << name;
    EXPECT_NEAR(pose[1], managed[name][1], 1e-3) << name;
    EXPECT_NEAR(pose[2], managed[name][2], 1e-3) << name;  // Listed with 0.1 degrees.
  }
}

}  // namespace
}  // namespace rave::cli_test
