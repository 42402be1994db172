// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "hand_over_drivers.hpp"

namespace rave::sim::testing {
namespace {

RobotType roaming(Numbers wheels = {}, double range_m = 3) {
  RobotType type = simulated_type(wheels);
  type.sensors.push_back(laser(16, 3, range_m));
  type.program = program<Roam>({}, 10);
  return type;
}

RobotType counting() {
  RobotType type = simulated_type();
  type.sensors.push_back(virtual_sensor<Counter>("counter"));
  type.program = program<Diary>({{"v", 0.5}}, 10);
  return type;
}

/// Two robots among boxes, one of which changes its drivers and back.
EngineSpec changing_crowd(unsigned threads) {
  EngineSpec spec;
  spec.threads = threads;
  spec.share_always = true;
  for (int i = 0; i < 6; ++i) {
    spec.world.obstacles.push_back(box({2.0 + (i % 3), -2.0 + 1.7 * i, 0.3 * i}, 0.6, 0.4));
  }
  add_robot(spec, roaming(), {0, 0, 0});
  add_drivers(spec, roaming({}, 2));
  add_robot(spec, roaming({{"shake", 0.02}}), {0, 1, 0});
  for (int i = 0; i < 100; ++i) add_twin(spec, {-1.0 - 0.5 * (i % 10), 0.5 * i - 25, 0});
  spec.hand_overs = {{50, RobotId(0), DriverSet::kTwin}, {250, RobotId(0), DriverSet::kFirst}};
  return spec;
}

TEST(HandOver, OfSimulatedDriversIsTheSameRunForAnyThreads) {
  const auto one = make_engine(changing_crowd(1));
  const auto two = make_engine(changing_crowd(2));
  const auto events = run(*one, 400);
  run(*two, 400);
  EXPECT_EQ(of_kind(events, EventKind::kHandedOver).size(), 2U);
  EXPECT_EQ(one->hash().value(), two->hash().value());
  ASSERT_TRUE(one->reset());
  EXPECT_EQ(of_kind(run(*one, 400), EventKind::kHandedOver).size(), 2U);
  EXPECT_EQ(one->hash().value(), two->hash().value());
}

TEST(HandOver, ThatIsNotMadeChangesTheRun) {
  EngineSpec spec = changing_crowd(1);
  spec.hand_overs.clear();
  const auto without = make_engine(std::move(spec));
  const auto with = make_engine(changing_crowd(1));
  run(*without, 51);
  run(*with, 51);
  EXPECT_NE(with->hash().value(), without->hash().value()) << "it stands";
}

TEST(HandOver, LeavesProgramAndPlaceAsTheyAre) {
  EngineSpec spec;
  const RobotId robot = add_robot(spec, counting(), {1, 2, 0});
  add_drivers(spec, counting());
  spec.hand_overs = {{100, robot, DriverSet::kTwin}};
  const auto engine = make_engine(std::move(spec));
  run(*engine, 101);
  const double before_m = engine->true_pose(robot).x;
  EXPECT_NEAR(before_m, 1.5, 0.01);
  const auto events = of_kind(run(*engine, 200), EventKind::kHandedOver);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events.front().step, 101U) << events.front().text;
  EXPECT_NE(events.front().text.find("moved by 0.0000 m"), std::string::npos)
      << events.front().text;
  EXPECT_GT(engine->true_pose(robot).x, before_m + 0.9) << "its program drives on";
  // One instance from the first decision to the last, and readings that go on counting.
  const auto& entries = Diary::entries();
  EXPECT_EQ(entries.size(), 31U);
  for (std::size_t i = 1; i < entries.size(); ++i) {
    EXPECT_GT(entries[i].sequence, entries[i - 1].sequence);
    EXPECT_EQ(entries[i].count, 1U);
  }
  EXPECT_LT(entries.back().first, 250) << "the counter of the other drivers began anew";
  const auto state = engine->hand_over_state(robot);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->active, DriverSet::kTwin);
  EXPECT_EQ(state->made, 1U);
  EXPECT_FALSE(state->under_way);
}

TEST(HandOver, OfARecordedRobotGoesOnWhereItWasReported) {
  EngineSpec spec;
  RobotType real = real_type({{"x", 1}, {"y", 2}, {"vx", 0.5}});
  RobotType simulated = simulated_type();
  simulated.sensors.push_back(virtual_sensor<Beacon>("mocap"));
  const RobotId robot = add_robot(spec, std::move(real));
  add_drivers(spec, std::move(simulated));
  const auto engine = make_engine(std::move(spec));
  run(*engine, 100);
  const double reported_m = engine->reported(robot).pose.x_m;
  EXPECT_NEAR(reported_m, 1.5, 0.02);
  ASSERT_TRUE(engine->hand_over(robot, DriverSet::kTwin));
  EXPECT_EQ(of_kind(run(*engine, 20), EventKind::kHandedOver).size(), 1U);
  EXPECT_NEAR(engine->true_pose(robot).x, reported_m, 0.02);
  EXPECT_EQ(engine->spec().world.robots[0].layer, Layer::kSimulatedRobots);
  EXPECT_EQ(engine->inputs_by_hand(), 1U);
  // A recording cannot begin in the middle, and the robot stays what it is.
  ASSERT_TRUE(engine->hand_over(robot, DriverSet::kFirst));
  const auto refused = of_kind(run(*engine, 20), EventKind::kHandOverRefused);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_NE(refused.front().text.find("plays a recording"), std::string::npos)
      << refused.front().text;
  EXPECT_EQ(engine->hand_over_state(robot)->active, DriverSet::kTwin);
  ASSERT_TRUE(engine->reset());
  run(*engine, 50);
  EXPECT_EQ(engine->spec().world.robots[0].layer, Layer::kRealRobots);
  EXPECT_NEAR(engine->reported(robot).pose.x_m, 1.25, 0.02);
}

TEST(HandOver, WithoutOtherDriversOrTwiceAtOnceIsRefused) {
  EngineSpec spec;
  const RobotId robot = add_robot(spec, counting());
  add_drivers(spec, counting());
  const RobotId plain = add_robot(spec, roaming(), {5, 5, 0});
  const auto engine = make_engine(std::move(spec));
  EXPECT_FALSE(engine->hand_over(plain, DriverSet::kTwin));
  EXPECT_FALSE(engine->hand_over_state(plain));
  EXPECT_FALSE(engine->hand_over(robot, DriverSet::kFirst)) << "it has them";
  ASSERT_TRUE(engine->hand_over(robot, DriverSet::kTwin));
  EXPECT_FALSE(engine->hand_over(robot, DriverSet::kTwin)) << "under way";
  run(*engine, 5);
  EXPECT_TRUE(engine->hand_over(robot, DriverSet::kFirst));
}

TEST(HandOver, OfRangesThatTheProgramWasNotToldOfIsRefused) {
  EngineSpec spec;
  const RobotId robot = add_robot(spec, roaming());
  RobotType other = simulated_type();
  other.sensors.push_back(laser(17, 3));
  other.program = program<Roam>({}, 10);
  add_drivers(spec, std::move(other));
  const auto engine = make_engine(std::move(spec));
  ASSERT_TRUE(engine->hand_over(robot, DriverSet::kTwin));
  const auto refused = of_kind(run(*engine, 3), EventKind::kHandOverRefused);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_NE(refused.front().text.find("17 ranges"), std::string::npos) << refused.front().text;
}

TEST(HandOver, OfAnotherNumberOfValuesIsRefused) {
  const auto with_values = [](double room) {
    RobotType type = simulated_type();
    type.sensors.push_back(real_sensor<Ticker>("ticker", {{"period_s", 0.01}, {"room", room}}));
    return type;
  };
  EngineSpec spec;
  const RobotId robot = add_robot(spec, with_values(4));
  add_drivers(spec, with_values(2));
  const auto engine = make_engine(std::move(spec));
  ASSERT_TRUE(engine->hand_over(robot, DriverSet::kTwin));
  const auto refused = of_kind(run(*engine, 3), EventKind::kHandOverRefused);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_NE(refused.front().text.find("`ticker` gives up to 2 values"), std::string::npos)
      << refused.front().text;
}

/// A pose source that is not open before the test lets it.
class LateToOpen final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  static std::atomic<bool> may_open;
  static std::atomic<int> closed;
  Status configure(const HardwareSetup&, HardwareDeclaration& declaration) override {
    declaration.clock = DriverClock::kLive;
    return {};
  }
  Status open(SampleSink&) override {
    may_open.wait(false);
    return {};
  }
  void close() override { ++closed; }
};
std::atomic<bool> LateToOpen::may_open = false;
std::atomic<int> LateToOpen::closed = 0;

/// Lets it, also when a test fails.
struct OpenAtLast {
  OpenAtLast() = default;
  OpenAtLast(const OpenAtLast&) = delete;
  OpenAtLast& operator=(const OpenAtLast&) = delete;
  ~OpenAtLast() { let(); }
  static void let() {
    LateToOpen::may_open = true;
    LateToOpen::may_open.notify_all();
  }
};

TEST(HandOver, ToDriversThatDoNotOpenIsGivenUpAndTheOldOnesStay) {
  const ClockAtZero clock;
  EngineSpec spec;
  spec.live_clock = &clock;
  const RobotId robot = add_simulated_or_real<LateToOpen>(spec);
  const auto engine = make_engine(std::move(spec));
  const OpenAtLast opened;
  ASSERT_TRUE(engine->hand_over(robot, DriverSet::kTwin));
  const auto refused = of_kind(run(*engine, 3005), EventKind::kHandOverRefused);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_NE(refused.front().text.find("did not open within 30 s"), std::string::npos)
      << refused.front().text;
  EXPECT_EQ(engine->hand_over_state(robot)->active, DriverSet::kFirst);
  EXPECT_FALSE(engine->hand_over_state(robot)->under_way);
  const Status again = engine->hand_over(robot, DriverSet::kTwin);
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().text().find("are still opening"), std::string::npos);
  EXPECT_EQ(LateToOpen::closed, 0);
  // What opens at last is closed again, and may be asked for.
  OpenAtLast::let();
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (LateToOpen::closed == 0 && std::chrono::steady_clock::now() < end) {
    run(*engine, 1);
    std::this_thread::yield();
  }
  EXPECT_EQ(LateToOpen::closed, 1);
  EXPECT_TRUE(engine->hand_over(robot, DriverSet::kTwin));
}

TEST(HandOver, OthersMakeWayForARobotThatHasBecomeReal) {
  const ClockAtZero clock;
  EngineSpec spec;
  spec.live_clock = &clock;
  // The 30 s in which drivers have to open are three million steps.
  spec.step = Duration{10'000};
  const RobotId robot = add_simulated_or_real<Told>(spec);
  const RobotId other = add_robot(spec, simulated_type(), {1, 0, 0});
  const auto engine = make_engine(std::move(spec));
  ASSERT_TRUE(engine->hand_over(robot, DriverSet::kTwin));
  // Its drivers are opened beside the run, so the step in which they serve is any.
  run(*engine, 1);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (Told::open_sink == nullptr && std::chrono::steady_clock::now() < end) {
    std::this_thread::yield();
  }
  SampleSink* const sink = Told::open_sink;
  ASSERT_NE(sink, nullptr);
  const auto say = [&](double x_m) {
    const PoseReading pose{.x_m = x_m};
    const SimTime now{static_cast<std::int64_t>(engine->steps_done()) * engine->spec().step.ns};
    return sink->publish(now, &pose, 1);
  };
  while (engine->hand_over_state(robot)->made == 0 && std::chrono::steady_clock::now() < end) {
    ASSERT_TRUE(say(0));
    run(*engine, 1);
    std::this_thread::yield();
  }
  ASSERT_EQ(engine->hand_over_state(robot)->made, 1U);
  ASSERT_TRUE(engine->snapshot().robot(robot).present);
  EXPECT_EQ(engine->true_pose(other).x, 1);
  ASSERT_TRUE(say(0.9));
  run(*engine, 3);
  EXPECT_NEAR(engine->true_pose(robot).x, 0.9, 1e-9) << "it is where it says";
  EXPECT_GT(engine->true_pose(other).x, 1.19) << "two radii of 0.15 m away";
  EXPECT_TRUE(engine->snapshot().robot(robot).present);
}

/// A pose source that never opens, and still speaks of it when the run is over.
class NeverOpens final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  static std::atomic<bool> opening;
  static std::atomic<bool> run_is_over;
  static std::atomic<bool> has_spoken;
  static std::atomic<bool> at_last;
  Status configure(const HardwareSetup& setup, HardwareDeclaration& declaration) override {
    host_ = setup.host;
    declaration.clock = DriverClock::kLive;
    return {};
  }
  Status open(SampleSink& sink) override {
    mark(opening);
    run_is_over.wait(false);
    host_.write(LogLevel::kInfo, "not yet");
    const PoseReading pose{};
    static_cast<void>(sink.publish(sink.now(), &pose, 1));
    mark(has_spoken);
    at_last.wait(false);
    return {};
  }
  void close() override {}
  static void mark(std::atomic<bool>& what) {
    what = true;
    what.notify_all();
  }

 private:
  HostServices host_;
};
std::atomic<bool> NeverOpens::opening = false;
std::atomic<bool> NeverOpens::run_is_over = false;
std::atomic<bool> NeverOpens::has_spoken = false;
std::atomic<bool> NeverOpens::at_last = false;  // for good: the thread goes with the process

std::atomic<int> kept_loaded = 0;

TEST(HandOver, ToDriversThatNeverOpenDoesNotHoldUpTheEndOfTheRun) {
  auto clock = std::make_unique<ClockAtZero>();
  auto ears = std::make_unique<Ears>();
  EngineSpec spec;
  spec.live_clock = clock.get();
  spec.log = ears.get();
  spec.last_wait = std::chrono::milliseconds(20);
  spec.keep_loaded = [](const void* function) { kept_loaded += function != nullptr ? 1 : 0; };
  const RobotId robot = add_simulated_or_real<NeverOpens>(spec);
  const std::string name = spec.robots.back().name;
  auto engine = make_engine(std::move(spec));
  ASSERT_TRUE(engine->hand_over(robot, DriverSet::kTwin));
  NeverOpens::opening.wait(false);
  run(*engine, 3);
  const Status again = engine->reset();
  ASSERT_FALSE(again) << "its drivers are in use";
  EXPECT_NE(again.error().text().find("cannot restart"), std::string::npos);
  engine.reset();
  const std::string expected = fmt::format(
      "robot {}: its real drivers, which do not serve, are still being opened: sensor `mocap` "
      "(driver `mocap`) has not returned; the run ends without it",
      name);
  EXPECT_NE(ears->heard.find(expected), std::string::npos) << ears->heard;
  EXPECT_GE(kept_loaded, 1) << "the plug-in of a thread that goes on";
  // What it says now reaches nobody, and nothing that is gone.
  ears.reset();
  clock.reset();
  NeverOpens::mark(NeverOpens::run_is_over);
  NeverOpens::has_spoken.wait(false);
}

TEST(HandOver, IsForOneProcess) {
  EngineSpec spec;
  add_robot(spec, counting());
  add_drivers(spec, counting());
  add_robot(spec, roaming(), {3, 3, 0});
  spec.local = {RobotId(0)};
  const auto engine = Engine::create(std::move(spec));
  ASSERT_FALSE(engine);
  EXPECT_NE(engine.error().text().find("one process"), std::string::npos);
}

}  // namespace
}  // namespace rave::sim::testing
