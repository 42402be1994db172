// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/sim/pose_report.hpp"
#include "rave/sim/sent_packet.hpp"
#include "rave/sim/world_input.hpp"

namespace rave::sim {

/// A contact of one robot.
struct TouchPoint {
  RobotId robot;
  Vec2 direction_W;  ///< Unit vector from the robot towards the contact.
};

/// A simulated robot that a real one has pushed aside, with its new pose.
struct PushedRobot {
  RobotId robot;
  Pose2 X_WR;
};

/// A robot whose body is scaled from this step on.
struct ResizedRobot {
  RobotId robot;
  double scale = 1;  ///< Scale relative to the outline in its file.
  std::string by{};  ///< Name of the user who requested it by hand, if any.
};

/// What became of an input of HostReport::inputs: it is among WorldStep::inputs, or among
/// WorldStep::refusals.
struct InputAnswer {
  std::uint32_t host = 0;      ///< That asked.
  std::uint64_t asked = 0;     ///< Its number there.
  std::uint64_t sequence = 0;  ///< Its number in the run.
};

/// The message of the authority to all hosts, one per step: the world that step `step` senses, and
/// the inputs of its robots. Its bits do not depend on the distribution of robots over hosts.
/// Doubles are sent bit by bit. Frames: poses X_WR in the world frame, velocities in the body
/// frame.
struct WorldStep {
  /// Bits of `flags`.
  static constexpr std::uint8_t kPresent = 1;  ///< Other robots can sense it.
  static constexpr std::uint8_t kLimited = 2;  ///< Something limited its last motion.

  std::uint64_t step = 0;
  bool last = false;  ///< No step follows, because a host is done.

  // By robot: the pose after the last motion; for real robots the reported pose of this step.
  std::vector<double> x_m;
  std::vector<double> y_m;
  std::vector<double> yaw_rad;
  std::vector<double> vx_mps;  ///< Actual velocity after limits; for real robots as reported.
  std::vector<double> vy_mps;
  std::vector<double> wz_radps;
  std::vector<std::uint8_t> flags;

  // Lists by RobotId, ascending, of the robots concerned.
  std::vector<PushedRobot> pushed;    ///< New poses, which replace those above.
  std::vector<TouchPoint> touches;    ///< Who touches something.
  std::vector<PoseReport> poses;      ///< All robots with a pose source.
  std::vector<PoseSample> samples;    ///< Real robots; by (robot, stamp).
  std::vector<ResizedRobot> resized;  ///< In the order of the changes.
  /// Obstacles added, moved or removed with this step, in that order, with their ids: new ones get
  /// the ids that follow those of all bodies so far.
  std::vector<ObstacleChange> obstacles;

  /// Messages that left their robots in the previous step.
  SentPackets sent;
  /// Inputs for robots that take effect with this step, in this order.
  std::vector<WorldInput> inputs;
  /// One for each input of the reports for this step, so that a host repeats no answered input.
  std::vector<InputAnswer> answers;
  /// The inputs that the authority refuses.
  std::vector<InputRefusal> refusals;

  /// Clears the lists, keeps the allocated memory, and resizes the columns to `robots`.
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
    answers.clear();
    refusals.clear();
  }
};

}  // namespace rave::sim
