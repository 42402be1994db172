// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/sim/pose_report.hpp"
#include "rave/sim/sent_packet.hpp"
#include "rave/sim/world_input.hpp"

namespace rave::sim {

/// Where one robot touches something.
struct TouchPoint {
  RobotId robot;
  Vec2 direction_W;  ///< Unit vector from the robot towards what it touches.
};

/// Where a simulated robot was pushed to by a real one.
struct PushedRobot {
  RobotId robot;
  Pose2 X_WR;
};

/// A robot whose body has another size from this step on.
struct ResizedRobot {
  RobotId robot;
  double scale = 1;  ///< Of the outline in its file.
  std::string by{};  ///< Who asked for it by hand, if it has a name.
};

/// The message of the authority to all hosts of a world, one per step, and the tick of the run:
/// the world that step `step` senses, and what reaches the robots in it. The same bits however the
/// robots are spread over hosts. Doubles travel bit by bit. Frames: poses X_WR in the world frame,
/// velocities in the body frame.
struct WorldStep {
  /// Bits of `flags`.
  static constexpr std::uint8_t kPresent = 1;  ///< Others can sense it.
  static constexpr std::uint8_t kLimited = 2;  ///< Something cut its last motion short.

  std::uint64_t step = 0;
  bool last = false;  ///< No step comes after this one: a host is done.

  // By robot. Where the last motion led; of real robots, where they are reported in this step.
  std::vector<double> x_m;
  std::vector<double> y_m;
  std::vector<double> yaw_rad;
  std::vector<double> vx_mps;  ///< What became of the proposal; of real robots as reported.
  std::vector<double> vy_mps;
  std::vector<double> wz_radps;
  std::vector<std::uint8_t> flags;

  // By RobotId, ascending, those for whom there is something to tell.
  std::vector<PushedRobot> pushed;    ///< Where they are instead of above.
  std::vector<TouchPoint> touches;    ///< Who touches something.
  std::vector<PoseReport> poses;      ///< All robots with a source of their pose.
  std::vector<PoseSample> samples;    ///< Of real robots; by (robot, stamp).
  std::vector<ResizedRobot> resized;  ///< In the order in which it happened.
  /// Obstacles that come, move or go with this step, in that order, each with its id: new ones have
  /// the numbers that follow those of all bodies so far.
  std::vector<ObstacleChange> obstacles;

  /// Messages that left their robots in the step before.
  SentPackets sent;
  /// What is asked of robots from this step on, in this order.
  std::vector<WorldInput> inputs;

  /// Drops what is not by robot and keeps the memory; makes room for `robots`.
  void begin(std::uint64_t of_step, std::size_t robots) {
    step = of_step;
    last = false;
    for (auto* const column : {&x_m, &y_m, &yaw_rad, &vx_mps, &vy_mps, &wz_radps}) {
      column->resize(robots);
    }
    flags.resize(robots);
    pushed.clear();
    touches.clear();
    poses.clear();
    samples.clear();
    resized.clear();
    obstacles.clear();
    sent.clear();
    inputs.clear();
  }
};

}  // namespace rave::sim
