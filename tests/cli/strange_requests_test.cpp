// SPDX-License-Identifier: Apache-2.0
// Who asks a run for what it should not: nonsense, other runs, processes that never answer.
#include <dds/dds.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <future>
#include <memory>
#include <sstream>

#include "bus_requests.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/request_box.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/writer.hpp"
#include "stranger.hpp"

namespace rave::cli_test {
namespace {

/// A bus in the test's process, from which anything can be sent.
class StrangeRequests : public BusRequests {
 protected:
  /// BusRequests of the test, and their answers.
  struct Asker {
    std::unique_ptr<bus::Bus> bus;
    bus::Reader<bus::HostInfo> infos;
    bus::Writer<bus::Request> requests;
    bus::Reader<bus::RequestAnswer> answers;
  };
  /// Says of itself that it belongs to the run.
  struct Pretender {
    std::unique_ptr<bus::Bus> bus;
    bus::Writer<bus::HostInfo> infos;
  };
  [[nodiscard]] Result<Pretender> pretend(std::uint32_t host, const char* name,
                                          const char* machine = "") const {
    RAVE_TRY_ASSIGN(auto bus, open_stranger(apart(), run_));
    RAVE_TRY_ASSIGN(auto infos, bus::Writer<bus::HostInfo>::create(*bus));
    bus::HostInfo info{};
    info.host = host;
    bus::put_text(info.name, name);
    bus::put_text(info.machine, machine);
    RAVE_TRY(infos.write(info));
    return Pretender{std::move(bus), std::move(infos)};
  }
  [[nodiscard]] Result<Asker> open_asker(const bus::RunId& run) const {
    RAVE_TRY_ASSIGN(auto bus, open_stranger(apart(), run));
    RAVE_TRY_ASSIGN(auto infos, bus::Reader<bus::HostInfo>::create(*bus));
    RAVE_TRY_ASSIGN(auto requests, bus::Writer<bus::Request>::create(*bus));
    RAVE_TRY_ASSIGN(auto answers, bus::Reader<bus::RequestAnswer>::create(*bus));
    return Asker{std::move(bus), std::move(infos), std::move(requests), std::move(answers)};
  }
  static void send(Asker& asker, std::uint64_t target, std::uint64_t number, std::string text) {
    bus::Request request{};
    request.target = target;
    request.number = number;
    bus::put_text(request.from, "a stranger");
    request.text._buffer = reinterpret_cast<std::uint8_t*>(text.data());
    request.text._length = static_cast<std::uint32_t>(text.size());
    EXPECT_TRUE(asker.requests.write(request));
  }
  /// In the partition of the asker's run, but of another run.
  static void stray(Asker& asker, std::uint64_t target, std::uint64_t number, std::string text) {
    bus::Request request{};
    std::ranges::copy(bus::RunId::random().bytes, request.run);
    request.writer = asker.bus->writer();
    request.target = target;
    request.number = number;
    bus::put_text(request.from, "a stranger");
    request.text._buffer = reinterpret_cast<std::uint8_t*>(text.data());
    request.text._length = static_cast<std::uint32_t>(text.size());
    // The bus would sign it with the run that it is in.
    EXPECT_EQ(dds_write(asker.requests.handle(), &request), DDS_RETCODE_OK);
  }
  std::uint64_t manager_of(Asker& asker) {
    std::uint64_t manager = 0;
    wait_until(
        [&] {
          asker.infos.take([&](const bus::HostInfo& info) {
            if (info.host == rave_wire_kNone) manager = info.writer;
          });
          return manager != 0;
        },
        "the manager says who it is");
    return manager;
  }

  bus::RunId run_ = bus::RunId::random();
};

TEST_F(StrangeRequests, WhoAsksNonsenseWithoutEndKeepsNobodyFromBeingHeard) {
  start_all("crowd.yaml", {"--duration", "100000", "--no-record", "--run", run_.text()});
  auto asker = open_asker(run_);
  ASSERT_TRUE(asker) << asker.error().text();
  const std::uint64_t manager = manager_of(*asker);
  std::string answered;
  std::string refusal;
  std::uint64_t number = 0;
  wait_until(
      [&] {
        for (int i = 0; i < 20; ++i) send(*asker, manager, ++number, "utter nonsense");
        asker->answers.take([&](const bus::RequestAnswer& answer) {
          (answer.taken ? answered : refusal) = bus::text_of(answer.text);
        });
        return !answered.empty() && !refusal.empty();
      },
      "nonsense is answered, and then is too much");
  EXPECT_NE(answered.find(R"("good":false)"), std::string::npos) << answered;
  EXPECT_NE(refusal.find("try again later"), std::string::npos) << refusal;
  EXPECT_NE(console("env").find("from `a stranger` over the bus: malformed request"),
            std::string::npos)
      << console("env");
  for (int i = 0; i < 200; ++i) send(*asker, manager, ++number, "utter nonsense");
  EXPECT_EQ(far({"edit", "remove", "pillar"}).exit_code, 0);
  end_by_hand("env");
}

TEST_F(StrangeRequests, WhatIsOfAnotherRunOrForAnotherProcessIsNotDone) {
  start_all("crowd.yaml", {"--duration", "100000", "--no-record", "--run", run_.text()});
  const std::string stop = R"({"rave":2,"do":"stop"})";
  std::uint64_t manager = 0;
  {
    auto asker = open_asker(run_);
    ASSERT_TRUE(asker) << asker.error().text();
    manager = manager_of(*asker);
    wait_until([&] { return asker->requests.readers() >= 3; }, "all hear it");
    send(*asker, manager + 1, 1, stop);
    stray(*asker, manager, 2, stop);
    send(*asker, manager, 3, R"({"rave":2,"do":"release"})");
    wait_until([&] { return logged("env", R"({"rave": 2, "do": "release"})"); },
               "what comes after both is heard");
    wait_until(
        [&] {
          return console("env").find("rave/request: 1 samples of other runs") != std::string::npos;
        },
        "that of another run has come");
  }
  {
    const auto other = bus::RunId::random();
    auto stranger = open_asker(other);
    ASSERT_TRUE(stranger) << stranger.error().text();
    wait_until([&] { return logged_foreign("env", other.text()); }, "the stranger is known");
    send(*stranger, manager, 1, stop);
    EXPECT_EQ(far({"edit", run_.text().substr(0, 8), "list"}).exit_code, 0);
    EXPECT_EQ(stranger->requests.readers(), 0U);
  }
  EXPECT_FALSE(logged("env", stop)) << console("env");
  end_by_hand("env");
}

TEST_F(StrangeRequests, AHostThatNeverAnswersMayBeTheOneThatHasIt) {
  start("env", "env", "crowd.yaml", {"--no-record", "--run", run_.text()});
  const auto pretender = pretend(1, "deaf host");
  ASSERT_TRUE(pretender) << pretender.error().text();
  const std::string answer = run_.text().substr(0, 8) + ": the run has not begun yet";
  wait_until(
      [&] {
        return far({"edit", run_.text(), "list"}).err.find(answer) != std::string::npos;
      },
      "the manager answers");
  const Words words = {"shadow", run_.text()};
  const Ended ended = far_until(words, "`deaf host` has not answered for 1.5 s");
  EXPECT_EQ(ended.exit_code, 2) << ended.out;
  EXPECT_NE(ended.err.find("`deaf host` has not answered for 1.5 s"), std::string::npos)
      << ended.err;
}

TEST_F(StrangeRequests, AStatusOfManyMessagesArrivesWhole) {
  const auto pretender = pretend(rave_wire_kNone, "environment manager", "far-away");
  ASSERT_TRUE(pretender) << pretender.error().text();
  auto robots = nlohmann::json::array();
  for (int i = 0; i < 12'000; ++i) {
    robots.push_back({{"name", fmt::format("rob\u00f6-{}", i)},
                      {"simulated", true},
                      {"armed", true},
                      {"stopped", false}});
  }
  const nlohmann::json answer = {{"good", true},
                                 {"text", ""},
                                 {"status",
                                  {{"scenario", "multitude"},
                                   {"sim_s", 1},
                                   {"duration_s", 10},
                                   {"pace", 1},
                                   {"live", true},
                                   {"paused", false},
                                   {"robots", robots}}}};
  const std::string line = answer.dump();
  ASSERT_GT(line.size(), 3 * std::size_t{rave_wire_kMaxRequestAnswerBytes});
  const auto begin = [&line](std::string_view) {
    return bus::BegunRequest{[&line] { return std::optional(line); }, {}, true};
  };
  auto box = bus::RequestBox::create(*pretender->bus, begin, nullptr);
  ASSERT_TRUE(box) << box.error().text();
  auto listed = std::async(std::launch::async, [this] {
    Ended ended = far({"ps", "--network", "--robots"});
    for (int i = 0; i < 9 && ended.out.find("multitude") == std::string::npos; ++i) {
      ended = far({"ps", "--network", "--robots"});
    }
    return ended;
  });
  wait_until(
      [&] {
        (*box)->serve();
        return listed.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
      },
      "it is listed");
  const std::string out = listed.get().out;
  EXPECT_NE(out.find(" 12000 "), std::string::npos) << out.substr(0, 1000);
  EXPECT_NE(out.find("far-away"), std::string::npos) << out.substr(0, 1000);
  for (int i = 0; i < 12'000; ++i) {
    ASSERT_NE(out.find(fmt::format("rob\u00f6-{} ", i)), std::string::npos) << i;
  }
}

TEST_F(StrangeRequests, AProcessThatNeverAnswersIsNamedWithWhatCanBeDone) {
  const auto pretender = pretend(rave_wire_kNone, "deaf one");
  ASSERT_TRUE(pretender) << pretender.error().text();
  const Ended ended = far({"edit", "list"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("`deaf one` has not answered for 5 s"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("rave top"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace rave::cli_test
