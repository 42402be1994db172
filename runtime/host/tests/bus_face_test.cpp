// SPDX-License-Identifier: Apache-2.0
// What those who look on at a run over its bus are told by a host, with two ends of a real bus.
#include "../src/bus_face.hpp"

#include <unistd.h>

#include <chrono>
#include <functional>
#include <random>
#include <set>
#include <thread>

#include "rave/assemble_testing/host_fixture.hpp"
#include "rave/bus/writer.hpp"
#include "rave/maps/map_messages.hpp"
#include "rave/onlook/listener.hpp"
#include "rave/recording/describe_run.hpp"
#include "rave/recording/record_keeper.hpp"
#include "rave/results/event_log.hpp"

namespace rave::runtime::testing {
namespace {

using Clock = std::chrono::steady_clock;
using onlook::Listener;

bus::BusConfig own_corner() {
  std::random_device chance;
  bus::BusConfig config;
  config.participant = "host";
  config.run = bus::RunId::random();
  config.domain = 1 + chance() % 90;
  config.tag = fmt::format("bus-face-test-{}-{}", ::getpid(), chance());
  config.beside = true;
  return config;
}

const std::string kLaser =
    ", sensors: [{name: laser, driver: virtual_laser, period_s: 0.01, mount: {z_m: 0.1}, "
    "params: {rays: 5, fov_deg: 4, range_max_m: 3}}]";

std::string robot_at(const std::string& name, double x_m, const std::string& more = {}) {
  return fmt::format("  - {{name: {}, pose: {{x_m: {}, y_m: 0}}, robot: {{{}, {}{}}}}}\n", name,
                     x_m, kBody, kWheels, more);
}

/// A host with its engine, and somebody who looks on.
class BusFaceTest : public ::testing::Test {
 protected:
  void start(const std::string& scenario) {
    corner_ = own_corner();
    auto bus = bus::Bus::open(corner_);
    ASSERT_TRUE(bus.has_value()) << bus.error().text();
    bus_ = *std::move(bus);
    auto face = BusFace::open(*bus_, 0, true, nullptr);
    ASSERT_TRUE(face.has_value()) << face.error().text();
    face_ = *std::move(face);
    engine_ = host_.engine_of(scenario);
    ASSERT_NE(engine_, nullptr);
    kinds_.emplace(engine_->spec(), host_.kinds());
    const record::RunInfo info;
    const record::StringMap hybrids;
    ASSERT_TRUE(face_->run_begins({*engine_, *kinds_, info, hybrids, false}).has_value());
  }

  void look_on() {
    bus::BusConfig config = corner_;
    config.participant = "onlooker";
    config.anonymous = true;
    auto bus = bus::Bus::open(config);
    ASSERT_TRUE(bus.has_value()) << bus.error().text();
    other_bus_ = *std::move(bus);
    auto listener = Listener::create(*other_bus_);
    ASSERT_TRUE(listener.has_value()) << listener.error().text();
    listener_.emplace(*std::move(listener));
  }

  void step() {
    ASSERT_TRUE(engine_->step().has_value());
    kinds_->learn(engine_->spec().world);
    face_->after_step({*engine_, crowd_, late_});
  }

  /// Both ends go on until something holds.
  [[nodiscard]] bool until(const std::function<bool()>& holds, bool steps = true) {
    const auto end = Clock::now() + std::chrono::seconds(20);
    while (Clock::now() < end) {
      if (steps) step();
      if (!steps) face_->held(*engine_);
      listener_->look(asked_);
      listener_->hear();
      for (auto& event : listener_->take_events()) events_.push_back(std::move(event));
      for (auto& one : listener_->take_obstacles()) obstacles_.push_back(std::move(one));
      if (holds()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
  }
  [[nodiscard]] bool has_event(sim::EventKind kind) const {
    return std::ranges::any_of(events_, [=](const auto& event) { return event.kind == kind; });
  }

  Host host_;
  bus::BusConfig corner_;
  std::unique_ptr<bus::Bus> bus_;
  std::unique_ptr<BusFace> face_;
  std::unique_ptr<sim::Engine> engine_;
  std::optional<BodyKinds> kinds_;
  std::unique_ptr<bus::Bus> other_bus_;
  std::optional<Listener> listener_;
  onlook::Asked asked_;
  std::vector<sim::Event> crowd_;  ///< Happens in each step beside the engine.
  bool late_ = false;              ///< Whether its steps are.
  std::vector<onlook::HeardEvent> events_;
  std::vector<onlook::HeardObstacle> obstacles_;
};

TEST_F(BusFaceTest, ReadingsComeWhileSomebodyLooksAtThem) {
  start(scenario_text(robot_at("a", 0, kLaser) + robot_at("b", 1, kLaser)));
  look_on();
  asked_.sensors = {{0, 0}};
  ASSERT_TRUE(until([&] { return listener_->readings().contains({0, 0, 0}); }));
  const onlook::ReadingAt& heard = listener_->readings().at({0, 0, 0});
  const sim::SensorSample sample = engine_->sensor(RobotId(0), 0);
  EXPECT_EQ(heard.rows, 5U);
  EXPECT_EQ(heard.fields, 1U);
  ASSERT_EQ(heard.values.size(), 5U);
  // Robot b stands 1 m ahead and is 0.3 m wide.
  EXPECT_NEAR(heard.values[2], static_cast<const float*>(sample.records)[2], 1e-3);
  EXPECT_NEAR(heard.values[2], 0.85, 0.01);
  // Nothing of what nobody asked for, and nothing old once it is not looked at any more.
  EXPECT_EQ(listener_->readings().size(), 1U);
  asked_.sensors = {{1, 0}};
  ASSERT_TRUE(until([&] { return listener_->readings().contains({1, 0, 0}); }));
  EXPECT_EQ(listener_->readings().size(), 1U);
}

TEST_F(BusFaceTest, LateStepsTellReadingsATenthAsOften) {
  start(scenario_text(robot_at("a", 0, kLaser)));
  look_on();
  asked_.sensors = {{0, 0}};
  ASSERT_TRUE(until([&] { return listener_->readings().contains({0, 0, 0}); }));
  late_ = true;
  std::set<double> stamps;
  const auto began = Clock::now();
  // One may have been on its way, and the first late one was due soon.
  ASSERT_TRUE(until([&] {
    const auto& readings = listener_->readings();
    if (const auto it = readings.find({0, 0, 0}); it != readings.end()) {
      stamps.insert(it->second.stamp_s);
    }
    return stamps.size() >= 5;
  }));
  // The three others come a third of a second apart; those of steps in time, thirty in a second.
  EXPECT_GE(Clock::now() - began, std::chrono::milliseconds(800));
}

TEST_F(BusFaceTest, TilesOfALocalMapComeOnceSomebodyAskedAndStayForOthers) {
  start(scenario_text(robot_at("a", 0, kLaser) + robot_at("b", 1, kLaser)));
  look_on();
  asked_.robots = true;
  std::vector<maps::MapTile> tiles;
  const auto some = [&] {
    for (auto& tile : listener_->take_tiles()) tiles.push_back(std::move(tile));
    return !tiles.empty();
  };
  ASSERT_TRUE(until([&] { return face_->robots_asked(); }));
  EXPECT_FALSE(some());
  asked_.maps = {1, 9};
  ASSERT_TRUE(until(some));
  EXPECT_EQ(tiles.front().source, "b");
  EXPECT_EQ(tiles.front().robot, 1U);
  // Somebody else, who comes later and asks for nothing.
  listener_.reset();
  other_bus_.reset();
  tiles.clear();
  look_on();
  asked_ = {};
  ASSERT_TRUE(until(some, false));
  EXPECT_EQ(tiles.front().source, "b");
}

TEST_F(BusFaceTest, AGlobalMapOfAnyProcessIsHeardWithoutAsking) {
  start(scenario_text(robot_at("a", 0)));
  auto writer = bus::Writer<bus::MapTile>::create(*bus_);
  ASSERT_TRUE(writer.has_value()) << writer.error().text();
  maps::MapTile tile{"fused", maps::kNoRobot, {0.1, {}, 2, 1}, 0, 0, 1, SimTime{5}, {0, 100}};
  bus::MapTile message = maps::message_of(tile);
  ASSERT_TRUE(writer->write(message).has_value());
  // Also by who comes later.
  look_on();
  std::vector<maps::MapTile> tiles;
  ASSERT_TRUE(until([&] {
    tiles = listener_->take_tiles();
    return !tiles.empty();
  }));
  EXPECT_EQ(tiles.front().source, "fused");
  EXPECT_EQ(tiles.front().robot, maps::kNoRobot);
  EXPECT_EQ(tiles.front().cells, tile.cells);
}

TEST_F(BusFaceTest, AReadingComesOfARunThatIsHeld) {
  start(scenario_text(robot_at("a", 0, kLaser) + robot_at("b", 1, kLaser)));
  for (int k = 0; k < 5; ++k) step();
  look_on();
  asked_.sensors = {{1, 0}};
  EXPECT_TRUE(until([&] { return listener_->readings().contains({1, 0, 0}); }, false));
}

TEST_F(BusFaceTest, ALookEndsWhenNobodyRepeatsIt) {
  start(scenario_text(robot_at("a", 0, kLaser)));
  look_on();
  asked_.robots = true;
  ASSERT_TRUE(until([&] { return face_->robots_asked(); }));
  listener_.reset();
  other_bus_.reset();
  const auto since = Clock::now();
  while (face_->robots_asked() && Clock::now() - since < std::chrono::seconds(10)) {
    step();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_FALSE(face_->robots_asked());
}

TEST_F(BusFaceTest, WhoComesLateKnowsWhoWasStopped) {
  start(scenario_text(robot_at("a", 0)));
  engine_->stop(RobotId(0), sim::Author::kHand);
  for (int k = 0; k < 5; ++k) step();
  look_on();
  ASSERT_TRUE(until([&] { return has_event(sim::EventKind::kStopped); }));
  const auto stopped =
      std::ranges::find(events_, sim::EventKind::kStopped, &onlook::HeardEvent::kind);
  EXPECT_EQ(stopped->robot, RobotId(0));
}

TEST_F(BusFaceTest, ContactsAreToldToThoseWhoLookButNotAllOfACrowd) {
  start(scenario_text(robot_at("a", 0) + robot_at("b", 5)));
  look_on();
  asked_.robots = true;
  ASSERT_TRUE(until([&] { return face_->robots_asked(); }));
  const sim::Event contact{0, RobotId(0), sim::EventKind::kContact, BodyId(1), "", 0};
  crowd_.assign(onlook::Teller::kMostContacts + 50, contact);
  ASSERT_TRUE(until([&] { return has_event(sim::EventKind::kContact); }));
  EXPECT_EQ(events_[0].robot, RobotId(0));
  EXPECT_EQ(events_[0].text, "with b");
  ASSERT_GT(events_.size(), onlook::Teller::kMostContacts);
  EXPECT_FALSE(events_[onlook::Teller::kMostContacts].robot.valid());
  EXPECT_EQ(events_[onlook::Teller::kMostContacts].text, "50 more in this step");
}

TEST_F(BusFaceTest, ObstaclesThatChangedAreToldToThoseWhoComeLate) {
  start(scenario_text(
      robot_at("a", 0),
      "obstacles: [{name: crate, box_m: [1, 1], x_m: 3, y_m: 0, z_m: [0, 1]}]\n"
      "changes:\n"
      "  - {at_s: 0.02, move_obstacle: {name: crate, x_m: 5, y_m: 1}}\n"
      "  - {at_s: 0.03, add_obstacle: {name: new, box_m: [1, 1], x_m: 8, y_m: 0, z_m: [0, "
      "1]}}\n"));
  for (int k = 0; k < 10; ++k) step();
  look_on();
  ASSERT_TRUE(until([&] { return obstacles_.size() == 2; }));
  std::ranges::sort(obstacles_, {}, &onlook::HeardObstacle::id);
  EXPECT_EQ(obstacles_[0].stands.name, "crate");
  EXPECT_EQ(obstacles_[0].stands.X_WB.x, 5);
  EXPECT_EQ(obstacles_[1].stands.name, "new");
  EXPECT_EQ(obstacles_[1].stands.X_WB.x, 8);
  EXPECT_TRUE(has_event(sim::EventKind::kObstacleMoved));
}

TEST_F(BusFaceTest, WhatConcernsTheWorldIsHeardOnceOfSeveralHosts) {
  start(scenario_text(robot_at("a", 0),
                      "obstacles: [{name: crate, box_m: [1, 1], x_m: 3, y_m: 0, z_m: [0, 1]}]\n"
                      "changes: [{at_s: 0.02, move_obstacle: {name: crate, x_m: 5, y_m: 1}}]\n"));
  bus::BusConfig config = corner_;
  config.participant = "host-2";
  auto bus = bus::Bus::open(config);
  ASSERT_TRUE(bus.has_value());
  auto second = BusFace::open(**bus, 1, true, nullptr);
  ASSERT_TRUE(second.has_value());
  const record::RunInfo info;
  const record::StringMap hybrids;
  ASSERT_TRUE((*second)->run_begins({*engine_, *kinds_, info, hybrids, false}).has_value());
  for (int k = 0; k < 10; ++k) {
    step();
    (*second)->after_step(*engine_);
  }
  engine_->stop(RobotId(0), sim::Author::kHand);
  step();
  (*second)->after_step(*engine_);
  look_on();
  // Of the robot both have told.
  const auto stops = [&] {
    return std::ranges::count(events_, sim::EventKind::kStopped, &onlook::HeardEvent::kind) == 2 &&
           !obstacles_.empty();
  };
  ASSERT_TRUE(until(stops));
  EXPECT_EQ(std::ranges::count(events_, sim::EventKind::kObstacleMoved, &onlook::HeardEvent::kind),
            1);
  EXPECT_EQ(obstacles_.size(), 1U);
  second->reset();
}

}  // namespace
}  // namespace rave::runtime::testing
