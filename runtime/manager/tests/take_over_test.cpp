// SPDX-License-Identifier: Apache-2.0
// A manager in real time that takes over: what it believes of the obstacles that hosts hand over,
// and what it tells hosts that come later.
#include <gtest/gtest.h>

#include <chrono>

#include "../src/live_edits.hpp"
#include "../src/live_hosts.hpp"
#include "own_corner.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::manager {
namespace {

using namespace sim::testing;
const lock_step::Identity kManager{rave_wire_kNone, "environment manager", 0, 7, 9, true};
constexpr std::uint32_t kFirstAdded = 2;  // behind a post and a robot

sim::EngineSpec a_robot_and_a_post() {
  sim::EngineSpec spec;
  spec.world.obstacles.push_back(box({8, 0, 0}, 0.2, 1, 1, "post"));
  add_robot(spec, simulated_type());
  sim::ObstacleChange late;
  late.name = "late";
  late.X_WB = {-5, 0, 0};
  late.body = box({}, 0.2, 0.2).body;
  spec.obstacle_changes.push_back({9'000, late});
  return spec;
}

/// The only host of the run, as far as the manager can tell.
class Host {
 public:
  explicit Host(bus::BusConfig config) {
    config.participant = "host";
    config.beside = true;
    bus_ = bus::Bus::open(config).value();
    info_.emplace(bus::Writer<bus::HostInfo>::create(*bus_).value());
    pings_.emplace(bus::Writer<bus::ClockPing>::create(*bus_).value());
    last_.emplace(bus::Writer<bus::LastObstacle>::create(*bus_).value());
    bus::HostInfo info = lock_step::introduction({0, "one", 1, 7, 9, true});
    EXPECT_TRUE(info_->write(info));
  }
  /// Has obstacles up to a change around its robots.
  void ping(std::uint64_t manager, std::uint64_t shown) {
    bus::ClockPing ping{};
    ping.target = manager;
    ping.bound_ns = -1;
    ping.run_ns = 0;
    ping.obstacle_revision = shown;
    EXPECT_TRUE(pings_->write(ping));
  }
  void hand_over(std::uint32_t id, std::uint64_t revision) {
    sim::ObstacleChange crate;
    crate.id = BodyId(id);
    crate.name = fmt::format("crate{}", id);
    crate.X_WB = {3, 0, 0};
    crate.body = box({}, 0.2, 0.2).body;
    lock_step::ObstacleParts parts;
    ASSERT_TRUE(parts.fill(std::span(&crate, 1)));
    bus::LastObstacle message{};
    message.id = id;
    message.revision = revision;
    message.stands = parts.changes().front();
    EXPECT_TRUE(last_->write(message));
  }

 private:
  std::unique_ptr<bus::Bus> bus_;
  std::optional<bus::Writer<bus::HostInfo>> info_;
  std::optional<bus::Writer<bus::ClockPing>> pings_;
  std::optional<bus::Writer<bus::LastObstacle>> last_;
};

class TakeOver : public ::testing::Test {
 protected:
  TakeOver() {
    options_.bus = own_corner();
    options_.identity = kManager;
    options_.hosts = {{"one", {0}}};
    options_.robots.push_back({"robot", from_seconds(1)});
    options_.log = &ears_;
    host_.emplace(options_.bus);
    hosts_ = LiveHosts::open(options_).value();
    edits_ = LiveEdits::create(a_robot_and_a_post(), options_, *hosts_).value();
  }
  /// The manager goes on until it is so.
  void go_until(const std::function<bool()>& so, const char* what) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!so() && std::chrono::steady_clock::now() < end) {
      host_->ping(board_writer_, shown_);
      hosts_->wait(Duration{10'000'000});
      ASSERT_TRUE(hosts_->look_at_processes(true));
      hosts_->take_pings([this](const bus::ClockPing& ping) { hosts_->claim_slot(ping); });
      ASSERT_TRUE(edits_->look(SimTime{}));
    }
    EXPECT_TRUE(so()) << what << "\n" << ears_.heard;
  }
  /// With what the host says that its robots have around them.
  void take_over(std::uint64_t shown, std::uint64_t published) {
    shown_ = shown;
    board_writer_ = hosts_->endpoint().writer();
    go_until([this] { return hosts_->slots()[0].writer != 0; }, "the host is here");
    go_until([this] { return hosts_->shown_revision() == shown_; }, "it says what it has");
    edits_->begin(true);
    EXPECT_EQ(edits_->revision(), shown) << "until it is known who knows what";
    go_until([&] { return edits_->revision() == published; }, "it has taken over");
  }
  [[nodiscard]] bool has(std::uint32_t id) const { return edits_->world().obstacle(id) != nullptr; }

  LiveManagerOptions options_;
  Ears ears_;
  std::optional<Host> host_;
  std::unique_ptr<LiveHosts> hosts_;
  std::unique_ptr<LiveEdits> edits_;
  std::uint64_t board_writer_ = 0;
  std::uint64_t shown_ = 0;
};

TEST_F(TakeOver, WithFewerObstaclesThanHostsHaveNobodyIsToldToWaitForTheRest) {
  host_->hand_over(kFirstAdded, 1);
  take_over(7, 1);
  EXPECT_TRUE(has(kFirstAdded));
  EXPECT_NE(ears_.heard.find("hosts have obstacles up to change 7, but sent only 1"),
            std::string::npos)
      << ears_.heard;
}

TEST_F(TakeOver, ChangesAreNumberedOnFromWhatHostsHave) {
  // Made by the manager before, and lost with it.
  host_->hand_over(kFirstAdded, 1);
  take_over(7, 1);
  ASSERT_TRUE(edits_->look(SimTime{from_seconds(100).ns}));
  EXPECT_TRUE(has(kFirstAdded + 1)) << "the change of the scenario";
  EXPECT_EQ(edits_->revision(), 8U) << "hosts would take a smaller number for one they have had";
}

TEST_F(TakeOver, ObstaclesThatCannotBeSpoilNothing) {
  // The last one is the newest, so that all have come when it is there.
  host_->hand_over(kFirstAdded + 100'001, 2);
  host_->hand_over(kFirstAdded + 100'002, 3);
  host_->hand_over(0, 4);
  host_->hand_over(kFirstAdded + 5, 5);
  host_->hand_over(kFirstAdded, 6);
  take_over(6, 6);
  go_until([this] { return has(kFirstAdded); }, "what was handed over is there");
  EXPECT_FALSE(has(kFirstAdded + 1));
  EXPECT_TRUE(hosts_->handed_obstacles().empty()) << "nobody needs them any more";
  const std::size_t told = ears_.heard.find("refused the hand-over of obstacles by process");
  ASSERT_NE(told, std::string::npos) << ears_.heard;
  EXPECT_EQ(ears_.heard.find("refused the hand-over of obstacles by process", told + 1),
            std::string::npos)
      << "once of each process:\n"
      << ears_.heard;
  EXPECT_NE(ears_.heard.find("1 obstacles from hosts are left out"), std::string::npos)
      << ears_.heard;
}

}  // namespace
}  // namespace rave::manager
