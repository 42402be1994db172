// SPDX-License-Identifier: Apache-2.0
// The guard of robots that do more, or less, than go forward and turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "../src/guard_fence.hpp"
#include "../src/robot_guard.hpp"
#include "guard_inputs.hpp"
#include "rave/base/random.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/world/touching.hpp"

namespace rave::sim {
namespace {

/// Steering 1 is a curve of 2 / m, throttle 1 is 2 m/s.
struct Car {
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    if (command.kind == CommandKind::kVelocity)
      return motion_of(command_for(asked_velocity(command)));
    if (command.kind != CommandKind::kPedals) return {};
    const double v_mps = 2 * command.value[1] * command.value[3] * (1 - command.value[2]);
    return {v_mps, 0, 2 * v_mps * command.value[0]};
  }
  [[nodiscard]] Command command_for(const Twist2& motion) const noexcept {
    if (motion.vx == 0) return pedals_command(0, 0, 1, 1);
    return pedals_command(std::clamp(motion.wz / motion.vx / 2, -1.0, 1.0),
                          std::min(std::abs(motion.vx) / 2, 1.0), 0, motion.vx > 0 ? 1 : -1);
  }
};

/// Any direction, as it is told.
struct Omni {
  [[nodiscard]] Twist2 motion_of(const Command& command) const noexcept {
    return asked_velocity(command);
  }
  [[nodiscard]] Command command_for(const Twist2& motion) const noexcept {
    return velocity_command(motion.vx, motion.wz, motion.vy);
  }
};

template <class T>
ActuatorDrive drive_of() {
  static constexpr DriveOps kOps = detail::drive_ops<T>();
  static constexpr T kOne;
  return {kOps, &kOne};
}

GuardInput car_input(const Command& command) {
  GuardInput in = input(0, 0);
  in.command = command;
  in.expected = CommandKind::kPedals;
  in.drive = drive_of<Car>();
  return in;
}

TEST(GuardOfDrives, APlainDriveIsAsBefore) {
  const ActuatorDrive plain;
  EXPECT_TRUE(plain.is_plain());
  EXPECT_EQ(plain.motion(velocity_command(0.3, -1)), (Twist2{0.3, 0, -1}));
  EXPECT_EQ(plain.command({0.3, 0.7, -1}), velocity_command(0.3, -1));
  EXPECT_EQ(plain.standing(CommandKind::kVelocity), velocity_command(0, 0));
  EXPECT_EQ(plain.standing(CommandKind::kJoint), Command{});
}

TEST(GuardOfDrives, ACarThatHasToStandBrakes) {
  GuardInput in = car_input(pedals_command(0.5, 1, 0, 1));
  in.stopped = true;
  const GuardOutput output = guard(GuardSpec{}, in);
  EXPECT_EQ(output.command, pedals_command(0, 0, 1, 1));
  EXPECT_TRUE(output.by(GuardLimit::kStopped));
  RobotGuard free;
  EXPECT_EQ(free.limit(in.command, in.expected, in.drive), in.command);
  free.stop();
  EXPECT_EQ(free.limit(in.command, in.expected, in.drive), pedals_command(0, 0, 1, 1));
}

TEST(GuardOfDrives, CapsKeepTheSteeringOfACar) {
  GuardSpec spec;
  spec.max_speed_mps = 0.5;
  const GuardOutput slow = guard(spec, car_input(pedals_command(0.5, 1, 0, -1)));
  EXPECT_NEAR(slow.command.value[0], 0.5, 1e-12);
  EXPECT_NEAR(slow.command.value[1], 0.25, 1e-12);
  EXPECT_EQ(slow.command.value[3], -1);
  EXPECT_TRUE(slow.by(GuardLimit::kSpeed));
  spec.max_turn_radps = 0.25;
  EXPECT_NEAR(guard(spec, car_input(pedals_command(0.5, 1, 0, 1))).command.value[1], 0.125, 1e-12);
  const Command small = pedals_command(0.1, 0.1, 0, 1);
  EXPECT_EQ(guard(spec, car_input(small)).command, small) << "to the bit";
}

TEST(GuardOfDrives, CapsKeepTheDirectionOfAnOmni) {
  GuardSpec spec;
  spec.max_speed_mps = 0.5;
  GuardInput in = input(0, 0);
  in.drive = drive_of<Omni>();
  in.command = velocity_command(0.6, 0, -0.8);
  const Command slow = guard(spec, in).command;
  EXPECT_NEAR(slow.value[0], 0.3, 1e-12);
  EXPECT_NEAR(slow.value[2], -0.4, 1e-12);
}

TEST(GuardOfDrives, VelocitiesOfACarAreGuardedAsWhatTheyBecome) {
  GuardSpec spec;
  spec.max_turn_radps = 1;
  GuardInput in = car_input(velocity_command(0.4, 5));
  in.expected = CommandKind::kVelocity;
  // The narrowest curve turns with 0.8 rad/s, which is allowed.
  EXPECT_EQ(guard(spec, in).acted, 0U);
  EXPECT_EQ(in.drive.motion(guard(spec, in).command), (Twist2{0.4, 0, 0.8}));
}

/// What a hostile program might tell a drive.
Command hostile(RandomStream& random, bool is_car) {
  if (is_car && random.bits() % 3 != 0) {
    constexpr double kGears[] = {-1, 0, 1, 1};
    return pedals_command(random.uniform(-1, 1), random.uniform(0, 1),
                          random.bits() % 4 == 0 ? random.uniform(0, 1) : 0,
                          kGears[random.bits() % 4]);
  }
  const double scale = random.bits() % 10 == 0 ? 1e6 : 3;
  return velocity_command(random.uniform(-scale, scale), random.uniform(-5, 5),
                          is_car ? 0 : random.uniform(-scale, scale));
}

template <class T>
void leaves_no_fence_and_touches_nobody(bool is_car) {
  int fenced = 0;
  int kept_apart = 0;
  for (std::uint32_t run = 0; run < 60; ++run) {
    RandomStream random(11, run, 1, 0);
    GuardSpec spec;
    spec.fence_W = square(2);
    if (run % 2 == 0) spec.fence_W = {{-2, -2}, {2, -2}, {2, 2}, {0, 0.5}, {-2, 2}};
    spec.separation_m = 0.1;
    spec.deceleration_mps2 = random.uniform(0.2, 3);
    spec.reaction_s = random.uniform(0, 0.2);
    const GuardNeighbour other{&disc(), {0.3, -1, 0}, {}};
    GuardInput in = input(0, 0, {-1, -1, random.uniform(-kPi, kPi)});
    in.drive = drive_of<T>();
    in.neighbours = std::span(&other, 1);
    for (int step = 0; step < 600; ++step) {
      if (step % 30 == 0) in.command = hostile(random, is_car);
      in.expected = in.command.kind;
      const GuardOutput output = guard(spec, in);
      fenced += output.by(GuardLimit::kFence) ? 1 : 0;
      kept_apart += output.by(GuardLimit::kSeparation) ? 1 : 0;
      in.velocity = in.drive.motion(output.command);
      in.X_WR = integrate(in.X_WR, in.velocity, in.dt_s);
      ASSERT_GE(inside_distance(spec.fence_W, in.X_WR.position()) - 0.2, -1e-3)
          << run << ' ' << step;
      ASSERT_GE(world::separation(disc(), in.X_WR, disc(), other.X_WB).distance_m, 0.1 - 1e-3)
          << run << ' ' << step;
    }
  }
  EXPECT_GT(fenced, 500);
  EXPECT_GT(kept_apart, 100);
}

TEST(GuardOfDrives, ACarLeavesNoFenceAndTouchesNobody) {
  leaves_no_fence_and_touches_nobody<Car>(true);
}

TEST(GuardOfDrives, AnOmniLeavesNoFenceAndTouchesNobody) {
  leaves_no_fence_and_touches_nobody<Omni>(false);
}

}  // namespace
}  // namespace rave::sim
