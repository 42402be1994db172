// SPDX-License-Identifier: Apache-2.0
// Real robots of live runs: what protects them does not wait for steps.
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <thread>

#include "live_fixture.hpp"
#include "rave/base_testing/no_threads.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::sim::testing {
namespace {

/// Where the drivers of a test find its cart.
class Cart;
Cart* the_cart = nullptr;

/// A real robot on a rail along x. It moves, and time passes, with each command.
class Cart {
 public:
  static constexpr double kStep_s = 0.02;
  Cart() {
    the_cart = this;
    hand.on_write = [this](const Command& command) {
      if (stands_still) return;
      if (!leans_against_wall) x_m_ = x_m_ + command.value[0] * kStep_s;
      farthest_m = std::max(farthest_m.load(), x_m_.load());
      clock.advance(kStep_s);
      say();
    };
  }
  ~Cart() { the_cart = nullptr; }
  Cart(const Cart&) = delete;
  Cart& operator=(const Cart&) = delete;

  void say() {
    const PoseReading pose{x_m_, 0, 0, 0, 0};
    const std::lock_guard lock(mutex_);
    if (sink_ != nullptr) static_cast<void>(sink_->publish(clock.now(), &pose, 1));
  }
  void connect(SampleSink* sink) {
    {
      const std::lock_guard lock(mutex_);
      sink_ = sink;
    }
    if (sink != nullptr) say();
  }

  HandClock clock;
  Hand hand;
  std::atomic<double> farthest_m = 0;
  std::atomic<bool> stands_still = false;  ///< And no time passes with its commands.
  std::atomic<bool> leans_against_wall = false;

 private:
  std::mutex mutex_;
  SampleSink* sink_ = nullptr;
  std::atomic<double> x_m_ = 0;
};

class CartPose final : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  Status configure(const HardwareSetup&, HardwareDeclaration& declaration) override {
    declaration.clock = DriverClock::kLive;
    return {};
  }
  Status open(SampleSink& sink) override {
    the_cart->connect(&sink);
    return {};
  }
  void close() override {
    if (the_cart != nullptr) the_cart->connect(nullptr);
  }
};

class CartWheels final : public HardwareActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  Status open(const DeviceSetup&) override { return {}; }
  Status write(const Command& command, SimTime) override {
    ErrorText error;
    if (the_cart->hand.write(command, &error) == 0) return {};
    return fail(ErrorCode::kIo, "{}", error.text);
  }
  void close() override {}
};

/// Hands on what it was given last, however old.
class Reckless final : public Controller {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  static constexpr CommandKind kGives = CommandKind::kVelocity;
  Status start(const DeviceSetup&) override { return {}; }
  Command control(const ControlInput& input) override { return input.command; }
};

class EngineLiveGuard : public ::testing::Test {
 protected:
  RobotType cart_type(double v_mps) {
    static constexpr HardwareActuatorOps kWheels = detail::hardware_actuator_ops<CartWheels>();
    static constexpr ControllerOps kReckless = detail::controller_ops<Reckless>();
    RobotType type = real_type({});
    type.sensors.front() = real_sensor<CartPose>("mocap", {});
    // That limit is on the clock of the machine, which most tests leave out.
    type.sensors.front().max_age_s = 1e6;
    type.actuators[0].hardware_ops = &kWheels;
    type.actuators[0].driver = "cart_wheels";
    type.controllers[0].ops = &kReckless;
    type.program = program<Drive>({{"v", v_mps}});
    type.guard = GuardSpec{};
    return type;
  }
  EngineSpec live_spec(RobotType type) {
    EngineSpec spec;
    spec.live_clock = &cart_.clock;
    spec.guard_period = from_seconds(0.001);
    spec.log = &ears_;
    spec.last_wait = std::chrono::milliseconds(200);
    robot_ = add_robot(spec, std::move(type));
    return spec;
  }

  Ears ears_;
  Cart cart_;
  RobotId robot_;
};

TEST_F(EngineLiveGuard, TheFenceHoldsWhileTheEngineStandsStill) {
  RobotType type = cart_type(1);
  type.guard->fence_W = {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}};
  type.guard->world_lost = WorldLostPolicy::kIgnore;
  type.guard->watchdog_s = 1e6;
  const auto engine = make_engine(live_spec(std::move(type)));
  run(*engine, 1);
  ASSERT_TRUE(cart_.hand.await_count(1500));
  EXPECT_LE(cart_.farthest_m, 2 - 0.15 + 1e-3);
  EXPECT_GT(cart_.farthest_m, 1.7) << "nothing else has stopped it";
  EXPECT_EQ(of_kind(run(*engine, 1), EventKind::kGuardSlowed).size(), 1U);
}

TEST_F(EngineLiveGuard, ARobotThatIsCommandedAndDoesNotMoveStandsAndTheReasonSaysBoth) {
  RobotType type = cart_type(0.3);
  type.guard->world_lost = WorldLostPolicy::kIgnore;
  type.guard->watchdog_s = 1e6;
  const auto engine = make_engine(live_spec(std::move(type)));
  run(*engine, 1);
  ASSERT_TRUE(cart_.hand.await(velocity_command(0.3, 0)));
  cart_.leans_against_wall = true;
  ASSERT_TRUE(cart_.hand.await(velocity_command(0, 0)));
  const auto stops = of_kind(run(*engine, 1), EventKind::kGuardStopped);
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_EQ(stops[0].detail, static_cast<std::uint32_t>(GuardLimit::kFrozen));
  EXPECT_EQ(stops[0].text,
            "frozen: the pose of `mocap` stays the same to the bit although the robot is commanded "
            "to move: the sensor repeats itself, or something holds the robot");
}

TEST_F(EngineLiveGuard, ARealRobotDoesNotMoveWithoutAThreadForItsGuard) {
  const base_testing::NoThreads none;
  const auto engine = Engine::create(live_spec(cart_type(0.3)));
  ASSERT_FALSE(engine);
  EXPECT_NE(engine.error().text().find("cannot start the thread of the guard of robot"),
            std::string::npos)
      << engine.error().text();
  EXPECT_TRUE(cart_.hand.told().empty());
  EXPECT_EQ(cart_.farthest_m, 0);
}

TEST_F(EngineLiveGuard, AStepThatDoesNotComeIsAWorldThatIsLost) {
  const auto engine = make_engine(live_spec(cart_type(0.3)));
  run(*engine, 1);
  ASSERT_TRUE(cart_.hand.await_count(100));
  ASSERT_TRUE(cart_.hand.await(velocity_command(0, 0)));
  EXPECT_LE(cart_.farthest_m, 0.3 * (0.5 + 2 * Cart::kStep_s));
  EXPECT_GT(cart_.farthest_m, 0.3 * 0.4);
  // The next step tells of it, once.
  const auto stops = of_kind(run(*engine, 1), EventKind::kGuardStopped);
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_EQ(stops[0].detail, static_cast<std::uint32_t>(GuardLimit::kWorldLost));
}

TEST_F(EngineLiveGuard, ACommandIsAsOldAsTheWallSays) {
  RobotType type = cart_type(0.3);
  type.program = program<Drive>({{"v", 0.3}, {"quiet_after", 1}});
  type.guard->watchdog_s = 0.3;
  const auto engine = make_engine(live_spec(std::move(type)));
  cart_.stands_still = true;
  run(*engine, 1);
  ASSERT_TRUE(cart_.hand.await(velocity_command(0.3, 0)));
  // One step later by the engine's time, and long after by the wall.
  cart_.clock.advance(0.4);
  cart_.say();
  run(*engine, 1);
  ASSERT_TRUE(cart_.hand.await_count(cart_.hand.told().size() + 3));
  EXPECT_EQ(cart_.hand.told().back(), velocity_command(0, 0));
}

TEST_F(EngineLiveGuard, APoseSourceThatFallsSilentStopsTheRobotWhateverItsStampsSay) {
  RobotType type = cart_type(0.3);
  type.sensors.front().max_age_s.reset();
  type.guard->world_lost = WorldLostPolicy::kIgnore;
  type.guard->watchdog_s = 1e6;
  // By the stamps no time passes.
  cart_.stands_still = true;
  const auto engine = make_engine(live_spec(std::move(type)));
  run(*engine, 1);
  ASSERT_TRUE(cart_.hand.await(velocity_command(0, 0)));
  // The thread tells of it after it has written.
  ASSERT_TRUE(cart_.hand.await_count(cart_.hand.told().size() + 2));
  const auto stops = of_kind(run(*engine, 1), EventKind::kGuardStopped);
  ASSERT_EQ(stops.size(), 1U);
  EXPECT_EQ(stops[0].text, "sensor lost: `mocap` has given no sample for more than 0.5 s");
}

TEST_F(EngineLiveGuard, TheTimeOfTheEngineMayBeFarBehindTheWall) {
  RobotType type = cart_type(0.3);
  type.guard->watchdog_s = 0.3;
  cart_.stands_still = true;
  const auto engine = make_engine(live_spec(std::move(type)));
  run(*engine, 1);
  cart_.clock.advance(5);
  cart_.say();
  // Its program commands in this step, 0.01 s after the first by the engine's time.
  run(*engine, 1);
  EXPECT_TRUE(cart_.hand.await(velocity_command(0.3, 0)));
  cart_.clock.advance(0.31);
  cart_.say();
  EXPECT_TRUE(cart_.hand.await(velocity_command(0, 0)));
}

TEST_F(EngineLiveGuard, TheWorldIsAsOldAsWhoBringsItSays) {
  cart_.stands_still = true;
  const auto engine = make_engine(live_spec(cart_type(0.3)));
  run(*engine, 1);
  ASSERT_TRUE(cart_.hand.await(velocity_command(0.3, 0)));
  engine->set_world_age(from_seconds(0.6));
  run(*engine, 1);
  ASSERT_TRUE(cart_.hand.await(velocity_command(0, 0)));
  engine->set_world_age({});
  run(*engine, 1);
  EXPECT_TRUE(cart_.hand.await(velocity_command(0.3, 0)));
}

TEST_F(EngineLiveGuard, AStopCountsBeforeTheNextStepAndStays) {
  cart_.stands_still = true;
  const auto engine = make_engine(live_spec(cart_type(0.3)));
  run(*engine, 1);
  ASSERT_TRUE(cart_.hand.await(velocity_command(0.3, 0)));
  engine->stop(robot_);
  ASSERT_TRUE(cart_.hand.await(velocity_command(0, 0)));
  run(*engine, 3);
  engine->arm(robot_);
  run(*engine, 1);
  const std::size_t count = cart_.hand.told().size();
  ASSERT_TRUE(cart_.hand.await_count(count + 3));
  const auto told = cart_.hand.told();
  EXPECT_TRUE(std::all_of(told.begin() + static_cast<std::ptrdiff_t>(count), told.end(),
                          [](const Command& c) { return c == velocity_command(0, 0); }));
  engine->release(robot_);
  run(*engine, 1);
  EXPECT_TRUE(cart_.hand.await(velocity_command(0.3, 0)));
  engine->halt();
  EXPECT_TRUE(cart_.hand.await(velocity_command(0, 0)));
}

TEST_F(EngineLiveGuard, OneThreadWritesFromTheFirstCommandToTheLast) {
  auto engine = make_engine(live_spec(cart_type(0.3)));
  run(*engine, 50);
  ASSERT_TRUE(cart_.hand.await_count(10));
  engine->halt();
  engine.reset();
  const auto writers = cart_.hand.writers();
  ASSERT_EQ(writers.size(), 1U);
  EXPECT_NE(writers[0], std::this_thread::get_id());
  EXPECT_EQ(cart_.hand.told().back(), velocity_command(0, 0));
}

TEST_F(EngineLiveGuard, AResetBeginsAnewWithAnotherThread) {
  const auto engine = make_engine(live_spec(cart_type(0.3)));
  cart_.stands_still = true;
  run(*engine, 3);
  ASSERT_TRUE(cart_.hand.await(velocity_command(0.3, 0)));
  ASSERT_TRUE(engine->reset());
  EXPECT_EQ(cart_.hand.told().back(), velocity_command(0, 0));
  run(*engine, 3);
  EXPECT_TRUE(cart_.hand.await(velocity_command(0.3, 0)));
}

TEST_F(EngineLiveGuard, WhatTheDriverSaysIsAnEventOnce) {
  cart_.stands_still = true;
  cart_.hand.fail_with("no power");
  const auto engine = make_engine(live_spec(cart_type(0.3)));
  // The guard may have written, and failed, before the first step has ended.
  std::vector<Event> events = run(*engine, 1);
  ASSERT_TRUE(cart_.hand.await_count(2));
  for (Event& event : run(*engine, 5)) events.push_back(std::move(event));
  const auto failed = of_kind(events, EventKind::kDriverFailed);
  ASSERT_EQ(failed.size(), 1U);
  EXPECT_EQ(failed[0].text, "actuator `wheels`: no power");
  EXPECT_EQ(engine->drive_trouble(robot_), "actuator `wheels`: no power");
  EXPECT_EQ(engine->actuator_command(robot_, 0), velocity_command(0.3, 0));
  cart_.hand.fail_with("");
  const std::size_t count = cart_.hand.told().size();
  ASSERT_TRUE(cart_.hand.await_count(count + 2));
  const auto back = of_kind(run(*engine, 5), EventKind::kDriverBack);
  ASSERT_EQ(back.size(), 1U);
  EXPECT_EQ(back[0].text, "actuator `wheels`: works again");
  EXPECT_EQ(engine->drive_trouble(robot_), "");
}

/// Whether a thread of this process may have priority in real time.
bool is_priority_granted() {
  bool granted = false;
  std::thread([&granted] {
    sched_param param{};
    param.sched_priority = 10;
    granted = pthread_setschedparam(pthread_self(), SCHED_FIFO, &param) == 0;
  }).join();
  return granted;
}

TEST_F(EngineLiveGuard, NamesTheDevicesThatNobodyStopsWhenTheProcessIsGone) {
  const std::string text =
      "guard: if this process is killed or suspended, only a watchdog of the device stops a robot; "
      "none is stated (`device_watchdog_s` of the actuator) for `r0` (driver "
      "`cart_wheels`)\n";
  make_engine(live_spec(cart_type(0.3))).reset();
  EXPECT_NE(ears_.heard.find(text), std::string::npos) << ears_.heard;
  const bool told =
      ears_.heard.find("guard: the system grants no real-time priority (SCHED_FIFO,") !=
      std::string::npos;
  EXPECT_NE(told, is_priority_granted()) << ears_.heard;
  ears_.heard.clear();
  RobotType without = cart_type(0.3);
  without.actuators[0].params = numbers({{"device_watchdog_s", 0}, {"baud", 9600}});
  make_engine(live_spec(std::move(without))).reset();
  EXPECT_NE(ears_.heard.find(text), std::string::npos) << ears_.heard;
  ears_.heard.clear();
  RobotType type = cart_type(0.3);
  type.actuators[0].params = numbers({{"device_watchdog_s", 0.2}});
  make_engine(live_spec(std::move(type))).reset();
  EXPECT_EQ(ears_.heard.find("watchdog"), std::string::npos) << ears_.heard;
}

/// Last: its thread goes with the process.
TEST(EngineLiveGuardEnd, ADriverThatHangsHoldsUpNeitherStepsNorTheEnd) {
  // For good: a thread that waits in them goes on when this function has returned.
  static Cart& cart = *new Cart;
  static Ears ears;
  cart.stands_still = true;
  cart.hand.hang();
  static constexpr HardwareActuatorOps kWheels = detail::hardware_actuator_ops<CartWheels>();
  EngineSpec spec;
  spec.live_clock = &cart.clock;
  spec.guard_period = from_seconds(0.001);
  spec.log = &ears;
  spec.last_wait = std::chrono::milliseconds(200);
  RobotType type = real_type({});
  type.sensors.front() = real_sensor<CartPose>("mocap", {});
  type.actuators[0].hardware_ops = &kWheels;
  type.program = program<Drive>({{"v", 0.3}});
  add_robot(spec, std::move(type));
  auto engine = make_engine(std::move(spec));
  run(*engine, 1);
  ASSERT_TRUE(cart.hand.await_hanging());
  EXPECT_TRUE(of_kind(run(*engine, 5), EventKind::kDriverFailed).empty());
  cart.clock.advance(0.6);
  const auto failed = of_kind(run(*engine, 5), EventKind::kDriverFailed);
  ASSERT_EQ(failed.size(), 1U);
  EXPECT_EQ(failed[0].text, "actuator `wheels`: has not returned from a command");
  engine.reset();
  EXPECT_NE(ears.heard.find("the guard of actuator `wheels` (driver `deaf`) is still closing"),
            std::string::npos)
      << ears.heard;
}

}  // namespace
}  // namespace rave::sim::testing
