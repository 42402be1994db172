// SPDX-License-Identifier: Apache-2.0
// Hand-overs of real robots that obey: when one counts as standing, and who may take over.
#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <thread>

#include "hand_over_drivers.hpp"
#include "rave/base_testing/no_threads.hpp"

namespace rave::sim::testing {
namespace {

constexpr double kStep_s = 0.01;

/// What the drivers of a test say at a time in seconds; nothing: they are silent.
using Script = std::function<std::optional<double>(double)>;
Script where_m;     // Set before an engine is made, and not while it is there.
Script wheels_mps;  // The same.

/// A recording of what a script says, every 10 ms. Own thread.
template <class Derived, class Record>
class Scripted : public HardwareSensor {
 public:
  static constexpr ReadingKind kReading = detail::kKindOf<Record>;
  Status configure(const HardwareSetup&, HardwareDeclaration&) override { return {}; }
  Status open(SampleSink& sink) override {
    thread_ = std::thread([&sink] {
      for (int k = 0; k < 3000; ++k) {
        const auto record = Derived::at(kStep_s * k);
        if (record && !sink.publish(SimTime{from_seconds(kStep_s * k).ns}, &*record, 1)) return;
      }
      sink.complete_up_to({std::numeric_limits<std::int64_t>::max()});
    });
    return {};
  }
  void close() override {
    if (thread_.joinable()) thread_.join();
  }
  ~Scripted() override { Scripted::close(); }

 private:
  std::thread thread_;
};

class ScriptedPose final : public Scripted<ScriptedPose, PoseReading> {
 public:
  static std::optional<PoseReading> at(double t_s) {
    const auto x_m = where_m(t_s);
    return x_m ? std::optional(PoseReading{.x_m = *x_m}) : std::nullopt;
  }
};

class ScriptedWheels final : public Scripted<ScriptedWheels, OdometryReading> {
 public:
  static std::optional<OdometryReading> at(double t_s) {
    const auto v_mps = wheels_mps(t_s);
    return v_mps ? std::optional(OdometryReading{.v_mps = *v_mps}) : std::nullopt;
  }
};

/// Wheels of a simulated robot, which nobody asks.
class IdleWheels final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kOdometry;
  Status configure(const VirtualSensorSetup&, VirtualDeclaration&) override { return {}; }
  void sample(const WorldView&, const SampleItem& item) const override {
    *static_cast<OdometryReading*>(item.records) = {};
    item.header->count = 1;
  }
};

/// Obeys unless its cable is out.
class Plugged final : public HardwareActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  static std::atomic<bool> cable_is_out;
  Status open(const DeviceSetup&) override { return {}; }
  Status write(const Command&, SimTime) override {
    if (cable_is_out) return fail(ErrorCode::kIo, "no answer");
    return {};
  }
  void close() override {}
};
std::atomic<bool> Plugged::cable_is_out = false;

/// A real robot that obeys, with wheels that are counted, and simulated drivers for it.
class RealHandOver : public ::testing::Test {
 protected:
  RealHandOver() {
    where_m = [](double) { return 1.0; };
    wheels_mps = [](double) { return 0.0; };
    Plugged::cable_is_out = false;
  }
  /// Steps until it has its simulated drivers, from this one on; nothing if it gets none in 20 s.
  std::optional<std::uint64_t> handed_over(std::uint64_t asked_at) {
    static constexpr HardwareActuatorOps kPlugged = detail::hardware_actuator_ops<Plugged>();
    EngineSpec spec;
    RobotType real = real_type({});
    real.actuators[0].hardware_ops = &kPlugged;
    real.sensors.front() = real_sensor<ScriptedPose>("mocap", {});
    real.sensors.push_back(real_sensor<ScriptedWheels>("wheels", {}));
    RobotType simulated = simulated_type();
    simulated.sensors.push_back(virtual_sensor<Beacon>("mocap"));
    simulated.sensors.push_back(virtual_sensor<IdleWheels>("wheels"));
    robot_ = add_robot(spec, std::move(real));
    add_drivers(spec, std::move(simulated));
    engine_ = make_engine(std::move(spec));
    run(*engine_, static_cast<int>(asked_at));
    EXPECT_TRUE(engine_->hand_over(robot_, DriverSet::kTwin));
    return wait();
  }
  std::optional<std::uint64_t> wait() {
    for (int step = 0; step < 2000; ++step) {
      for (const Event& event : run(*engine_, 1)) {
        if (event.kind == EventKind::kHandOverRefused) refusal_ = event.text;
        if (event.kind == EventKind::kHandedOver) return event.step;
      }
      if (!engine_->hand_over_state(robot_)->under_way) break;
    }
    return std::nullopt;
  }

  std::unique_ptr<Engine> engine_;
  RobotId robot_;
  std::string refusal_;
};

TEST_F(RealHandOver, ComesWhenItWasSeenToStandForAWhile) {
  const auto step = handed_over(50);
  ASSERT_TRUE(step) << refusal_;
  EXPECT_GE(*step, 80U);
  EXPECT_LE(*step, 84U);
}

TEST_F(RealHandOver, WaitsForARobotThatIsSeenToMove) {
  where_m = [](double t_s) { return 0.2 * std::min(t_s, 1.0); };
  const auto step = handed_over(50);
  ASSERT_TRUE(step) << refusal_;
  EXPECT_GE(*step, 150U);
}

TEST_F(RealHandOver, WaitsForARobotThatNobodySees) {
  where_m = [](double t_s) { return t_s > 0.3 && t_s < 3 ? std::nullopt : std::optional(1.0); };
  const auto step = handed_over(100);
  ASSERT_TRUE(step) << refusal_;
  EXPECT_GE(*step, 330U);
}

TEST_F(RealHandOver, WaitsForWheelsThatTurnWhereverTheRobotSeemsToBe) {
  wheels_mps = [](double t_s) { return t_s < 2 ? 0.01 : 0.0; };
  const auto step = handed_over(50);
  ASSERT_TRUE(step) << refusal_;
  EXPECT_GE(*step, 230U);
}

TEST_F(RealHandOver, WaitsForNewCountsOfWheels) {
  wheels_mps = [](double t_s) { return t_s > 0.3 && t_s < 3 ? std::nullopt : std::optional(0.0); };
  const auto step = handed_over(100);
  ASSERT_TRUE(step) << refusal_;
  EXPECT_GE(*step, 330U);
}

TEST_F(RealHandOver, WaitsForWheelsThatHaveNeverBeenCounted) {
  wheels_mps = [](double t_s) { return t_s < 3 ? std::nullopt : std::optional(0.0); };
  const auto step = handed_over(100);
  ASSERT_TRUE(step) << refusal_;
  EXPECT_GE(*step, 330U);
}

TEST_F(RealHandOver, IsRefusedWhileItsWheelsDoNotObey) {
  Plugged::cable_is_out = true;
  EXPECT_FALSE(handed_over(50));
  EXPECT_NE(refusal_.find("it did not come to rest within 10 s"), std::string::npos) << refusal_;
  EXPECT_EQ(engine_->hand_over_state(robot_)->active, DriverSet::kFirst);
  Plugged::cable_is_out = false;
  run(*engine_, 2);
  ASSERT_TRUE(engine_->hand_over(robot_, DriverSet::kTwin));
  EXPECT_TRUE(wait()) << refusal_;
}

/// A simulated robot in a live run, whose real drivers say where it is when the test says so.
class BecomesReal : public ::testing::Test {
 protected:
  void begin(const std::function<void(RobotType& simulated, RobotType& real)>& adapt = {}) {
    spec_.live_clock = &clock_;
    // The 30 s in which drivers have to open are three million steps.
    spec_.step = Duration{10'000};
    robot_ = add_simulated_or_real<Told>(spec_);
    if (adapt) adapt(spec_.types[0], spec_.types[1]);
    engine_ = make_engine(std::move(spec_));
    run(*engine_, 100);
  }
  /// Begins a hand-over; its drivers are opened beside the run.
  void ask() {
    ASSERT_TRUE(engine_->hand_over(robot_, DriverSet::kTwin));
    run(*engine_, 1);
    while (Told::open_sink == nullptr && !is_late()) std::this_thread::yield();
    ASSERT_NE(Told::open_sink, nullptr);
  }
  /// Says that the robot is there, as of so long ago, and makes a step.
  void say(double x_m, Duration ago = {}) {
    const PoseReading pose{.x_m = x_m};
    const auto now_ns = static_cast<std::int64_t>(engine_->steps_done()) * 10'000;
    SampleSink* const sink = Told::open_sink;
    if (sink != nullptr) static_cast<void>(sink->publish(SimTime{now_ns - ago.ns}, &pose, 1));
    for (Event& event : run(*engine_, 1)) events_.push_back(std::move(event));
    std::this_thread::yield();
  }
  [[nodiscard]] bool is_late() const { return std::chrono::steady_clock::now() > end_; }
  [[nodiscard]] bool under_way() const { return engine_->hand_over_state(robot_)->under_way; }

  const std::chrono::steady_clock::time_point end_ =
      std::chrono::steady_clock::now() + std::chrono::seconds(60);
  const ClockAtZero clock_;
  EngineSpec spec_;
  RobotId robot_;
  std::unique_ptr<Engine> engine_;
  std::vector<Event> events_;
};

TEST_F(BecomesReal, WithoutAThreadItsDriversAreOpenedByTheRun) {
  begin();
  {
    const base_testing::NoThreads none;
    ask();
  }
  while (under_way() && !is_late()) say(engine_->true_pose(robot_).x);
  EXPECT_EQ(engine_->hand_over_state(robot_)->made, 1U);
}

TEST_F(BecomesReal, WithoutAThreadForItsGuardItIsStopped) {
  Ears ears;
  spec_.log = &ears;
  static constexpr HardwareActuatorOps kPlugged = detail::hardware_actuator_ops<Plugged>();
  Plugged::cable_is_out = false;
  begin([](RobotType&, RobotType& real) {
    real.guard = GuardSpec{};
    // Who obeys nobody needs no guard.
    real.actuators[0].hardware_ops = &kPlugged;
  });
  ask();
  {
    const base_testing::NoThreads none;
    while (under_way() && !is_late()) say(engine_->true_pose(robot_).x);
  }
  const auto made = of_kind(events_, EventKind::kHandedOver);
  ASSERT_EQ(made.size(), 1U);
  EXPECT_NE(made[0].text.find("; it is stopped, because its guard has no thread"),
            std::string::npos)
      << made[0].text;
  EXPECT_NE(ears.heard.find("cannot start the thread of the guard of robot"), std::string::npos)
      << ears.heard;
  EXPECT_TRUE(engine_->stopped(robot_));
}

TEST_F(BecomesReal, WhereItWasLongAgoIsNotWhereItIs) {
  begin([](RobotType& simulated, RobotType& real) {
    simulated.program = program<Drive>({{"v", 0.5}});
    real.program = program<Drive>({{"v", 0.5}});
    real.staleness = Duration{200'000};
  });
  ask();
  constexpr Duration kLongAgo{500'000};
  // When it stands it was heard, and nothing else is awaited.
  while (engine_->snapshot().velocity_W(robot_).vx != 0 && !is_late()) {
    say(engine_->true_pose(robot_).x, kLongAgo);
  }
  for (int step = 0; step < 200; ++step) say(engine_->true_pose(robot_).x, kLongAgo);
  EXPECT_TRUE(under_way());
  EXPECT_EQ(engine_->hand_over_state(robot_)->made, 0U);
  say(engine_->true_pose(robot_).x);
  say(engine_->true_pose(robot_).x);
  EXPECT_EQ(engine_->hand_over_state(robot_)->made, 1U);
}

TEST_F(BecomesReal, NotWhenItIsElsewhere) {
  begin();
  ask();
  while (under_way() && !is_late()) say(0.3);
  const auto refused = of_kind(events_, EventKind::kHandOverRefused);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_NE(refused[0].text.find("which is 0.300 m and 0.0 degrees from its present pose"),
            std::string::npos)
      << refused[0].text;
  EXPECT_EQ(engine_->hand_over_state(robot_)->made, 0U);
  EXPECT_EQ(engine_->spec().world.robots[0].layer, Layer::kSimulatedRobots);
}

TEST_F(BecomesReal, WhereItsOtherDriversSawItIsNoPartOfHowItMoves) {
  begin([](RobotType& simulated, RobotType&) {
    simulated.sensors[0] = virtual_sensor<Beacon>("mocap", {{"offset_m", 0.2}});
    simulated.pose_from = 0;
  });
  run(*engine_, 4000);
  ASSERT_NEAR(engine_->reported(robot_).pose.x_m, 0.2, 1e-9);
  ask();
  while (under_way() && !is_late()) say(0.1);
  ASSERT_EQ(engine_->hand_over_state(robot_)->made, 1U);
  for (int step = 0; step < 5; ++step) say(0.1);
  EXPECT_NEAR(engine_->reported(robot_).pose.x_m, 0.1, 1e-9);
  EXPECT_EQ(engine_->reported(robot_).velocity.vx, 0) << "the two see it at two places";
}

TEST_F(BecomesReal, NotWithABodyOfAnotherSize) {
  begin();
  const ParameterChange larger[] = {{ParameterChange::Part::kBody, 0, "scale", 1.2}};
  ASSERT_TRUE(engine_->set_parameters(robot_, larger));
  run(*engine_, 1);
  const Status refused = engine_->hand_over(robot_, DriverSet::kTwin);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "the body of robot `r0` has `scale` 1.2; a real one has 1");
}

TEST_F(BecomesReal, WhoArmedTheOneHasNotArmedTheOther) {
  begin([](RobotType&, RobotType& real) {
    real.guard = GuardSpec{};
    real.guard->arm = true;
  });
  EXPECT_TRUE(engine_->armed(robot_));
  ask();
  while (under_way() && !is_late()) say(0);
  ASSERT_EQ(engine_->hand_over_state(robot_)->made, 1U);
  EXPECT_FALSE(engine_->armed(robot_));
  const auto made = of_kind(events_, EventKind::kHandedOver);
  ASSERT_EQ(made.size(), 1U);
  EXPECT_NE(made[0].text.find("it stands until it is armed"), std::string::npos) << made[0].text;
}

}  // namespace
}  // namespace rave::sim::testing
