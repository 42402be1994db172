// SPDX-License-Identifier: Apache-2.0
// Samples that are refused, and such that do not continue those before.
#include "fuse_drivers.hpp"
#include "live_fixture.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::sim::testing {
namespace {

Hand* the_hand = nullptr;

class HandWheels final : public HardwareActuator {
 public:
  static constexpr CommandKind kAccepts = CommandKind::kVelocity;
  Status open(const DeviceSetup&) override { return {}; }
  Status write(const Command& command, SimTime) override {
    ErrorText error;
    return the_hand->write(command, &error) == 0 ? Status{} : fail(ErrorCode::kIo, "broken");
  }
  void close() override {}
};

/// A real robot that is told to drive and stays where the test says it is.
class EngineBreaks : public ::testing::Test {
 protected:
  EngineBreaks() {
    the_hand = &hand_;
    static constexpr HardwareActuatorOps kWheels = detail::hardware_actuator_ops<HandWheels>();
    RobotType type = real_type({});
    type.sensors.front() = real_sensor<HandFedPose>("mocap", {{"live", 1}});
    type.sensors.push_back(real_sensor<HandFedBumper>("bumper", {{"live", 1}, {"port", 1}}));
    type.sensors.back().max_age_s = 1e6;
    type.actuators[0].hardware_ops = &kWheels;
    type.program = program<Drive>({{"v", 0.3}});
    type.guard = GuardSpec{};
    type.guard->max_speed_mps = 0.5;
    EngineSpec spec;
    spec.live_clock = &clock_;
    spec.guard_period = from_seconds(0.001);
    spec.last_wait = std::chrono::milliseconds(200);
    robot_ = add_robot(spec, std::move(type));
    engine_ = make_engine(std::move(spec));
    const ContactReading nothing{};
    EXPECT_TRUE(HandFedBumper::port(1)->publish(clock_.now(), &nothing, 1));
  }
  /// A step of the engine in which the sensor has said this.
  void step(double x_m, double yaw_rad = 0) {
    clock_.advance(0.01);
    const PoseReading pose{x_m, 0, yaw_rad, 0, 0};
    ASSERT_TRUE(HandFedPose::port(0)->publish(clock_.now(), &pose, 1));
    for (Event& event : run(*engine_, 1)) events_.push_back(std::move(event));
  }
  void steps(int count, double x_m) {
    for (int i = 0; i < count; ++i) step(x_m);
  }

  HandClock clock_;
  Hand hand_;
  RobotId robot_;
  std::unique_ptr<Engine> engine_;
  std::vector<Event> events_;
};

TEST_F(EngineBreaks, APoseThatIsNotBelievedIsNamedOnceAndCounts) {
  steps(10, 1);
  ASSERT_TRUE(hand_.await(velocity_command(0.3, 0)));
  for (int i = 0; i < 200; ++i) step(1, i % 3 == 0 ? kPi : 0);
  step(500);
  EXPECT_EQ(engine_->reported(robot_).pose.x_m, 1);
  EXPECT_EQ(engine_->reported(robot_).pose.yaw_rad, 0);
  const auto refused = of_kind(events_, EventKind::kPoseRefused);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_TRUE(refused[0].text.starts_with("sensor `mocap`: it says (1.00, 0.00) m, 180 deg, but"))
      << refused[0].text;
  EXPECT_TRUE(engine_->armed(robot_));
  // After a while it is news again.
  steps(60, 1);
  step(500);
  EXPECT_EQ(of_kind(events_, EventKind::kPoseRefused).size(), 2U);
  EXPECT_TRUE(of_kind(events_, EventKind::kDisarmed).empty());
}

TEST_F(EngineBreaks, ANewPlaceDisarmsUntilSomebodyArms) {
  steps(10, 1);
  ASSERT_TRUE(hand_.await(velocity_command(0.3, 0)));
  steps(53, 20);
  EXPECT_EQ(engine_->reported(robot_).pose.x_m, 20);
  const auto disarmed = of_kind(events_, EventKind::kDisarmed);
  ASSERT_EQ(disarmed.size(), 1U);
  EXPECT_TRUE(disarmed[0].text.starts_with("sensor `mocap`: its poses are at (20.00, 0.00) m"))
      << disarmed[0].text;
  EXPECT_FALSE(engine_->armed(robot_));
  ASSERT_TRUE(hand_.await(velocity_command(0, 0)));
  steps(100, 20);
  EXPECT_EQ(hand_.told().back(), velocity_command(0, 0));
  engine_->arm(robot_);
  steps(2, 20);
  EXPECT_TRUE(hand_.await(velocity_command(0.3, 0)));
}

TEST_F(EngineBreaks, AClockThatWasSetDisarmsAtOnceAndNotOnlyWithAStep) {
  steps(10, 1);
  ASSERT_TRUE(hand_.await(velocity_command(0.3, 0)));
  constexpr std::string_view kText = "its clock was set";
  HandFedBumper::port(1)->begin_anew(kText.data(), kText.size());
  ASSERT_TRUE(hand_.await(velocity_command(0, 0))) << "no step has come";
  clock_.advance(0.001);
  const ContactReading nothing{};
  ASSERT_TRUE(HandFedBumper::port(1)->publish(clock_.now(), &nothing, 1));
  steps(3, 1);
  const auto disarmed = of_kind(events_, EventKind::kDisarmed);
  ASSERT_EQ(disarmed.size(), 1U);
  EXPECT_EQ(disarmed[0].text, "sensor `bumper`: its clock was set");
  engine_->arm(robot_);
  steps(2, 1);
  EXPECT_TRUE(hand_.await(velocity_command(0.3, 0)));
}

TEST_F(EngineBreaks, NoSpeedIsEstimatedAcrossABreak) {
  steps(10, 1);
  HandFedPose::port(0)->begin_anew("clock set", 9);
  steps(2, 1.4);
  EXPECT_EQ(engine_->reported(robot_).pose.x_m, 1.4);
  EXPECT_EQ(engine_->reported(robot_).velocity.vx, 0);
}

/// A pose in a recording, and a robot that nobody commands: nothing to disarm.
TEST(EngineBreaksOfARecording, ANewPlaceIsAnEventAtTheSampleThatBeganIt) {
  EngineSpec spec;
  RobotType type = real_type({});
  type.sensors.front() = real_sensor<HandFedPose>("mocap", {});
  const RobotId robot = add_robot(spec, std::move(type));
  const auto engine = make_engine(std::move(spec));
  SampleSink& sink = *HandFedPose::port(0);
  // Far ahead of the run.
  for (int i = 0; i < 200; ++i) {
    const PoseReading pose{i < 100 ? 1.0 : 200.0, 0, 0, 0, 0};
    ASSERT_TRUE(sink.publish(SimTime{} + from_seconds(0.01 * i), &pose, 1));
  }
  sink.complete_up_to(SimTime{} + from_seconds(10));
  auto events = run(*engine, 140);
  EXPECT_EQ(engine->reported(robot).pose.x_m, 1);
  EXPECT_TRUE(of_kind(events, EventKind::kSensorRestarted).empty());
  events = run(*engine, 40);
  EXPECT_EQ(engine->reported(robot).pose.x_m, 200);
  ASSERT_EQ(of_kind(events, EventKind::kSensorRestarted).size(), 1U);
  EXPECT_EQ(of_kind(events, EventKind::kSensorRestarted)[0].step, 150U);
  EXPECT_EQ(of_kind(events, EventKind::kPoseRefused).size(), 1U);
}

}  // namespace
}  // namespace rave::sim::testing
