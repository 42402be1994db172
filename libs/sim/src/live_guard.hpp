// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "frozen_watch.hpp"
#include "pose_track.hpp"
#include "range_watch.hpp"
#include "rave/base/time.hpp"
#include "rave/robot/sample_queue.hpp"
#include "rave/sim/guard.hpp"
#include "rave/sim/reported_pose.hpp"
#include "robot_guard.hpp"

namespace rave::sim {

/// What the engine wants of one actuator of a real robot.
struct ActuatorDemand {
  Command command;                                ///< From the controller that speaks.
  CommandKind expected = CommandKind::kVelocity;  ///< What the controller gives.
  bool watched = false;                           ///< A program has to command again and again.
  std::optional<SimTime> given;  ///< When it did last, by the clock of the run; nothing: never.
  ActuatorDrive drive{};         ///< What the actuator makes of commands.
};

/// What the guard of a real robot has to know in a live run, as of one step. Moments are by the
/// clock of the run. Keeps what it points to.
struct GuardOrder {
  std::vector<ActuatorDemand> demands;  ///< By actuator of the robot's type.
  GuardHolds holds;
  /// How often samples of the robot's sensors, as far as the guard knows them, began anew until
  /// `holds` was found.
  std::uint32_t breaks = 0;
  SimTime world_time;     ///< Of the virtual world that the demands were made in.
  ReportedPose reported;  ///< For a robot whose pose does not come from a live sensor.
  double radius_m = 0;
  std::shared_ptr<const world::Body> body;  ///< Shared with the engine, which may replace its own.
  bool sees_others = true;                  ///< False: its neighbours are unknown.
  std::vector<GuardNeighbour> neighbours;   ///< As of `world_time`.
  std::vector<std::shared_ptr<const world::Body>> bodies;  ///< Of the neighbours.
};

/// The sensor that says where a real robot is.
struct LivePose {
  const SampleQueue* queue = nullptr;  ///< Null: GuardOrder::reported counts. Not owned.
  ReadingKind kind = ReadingKind::kPose;
  Pose2 X_WM;               ///< Frame of the sensor.
  Duration staleness;       ///< An older pose is lost.
  std::uint32_t index = 0;  ///< Of the sensor in the robot's type.
};

/// A sensor of a real robot that must not fall silent: see sensor_age.hpp.
struct LiveSensor {
  std::uint32_t index = 0;             ///< In the robot's type.
  const SampleQueue* queue = nullptr;  ///< Not owned.
  double max_age_s = 0;
  bool is_judged_by_link = false;
};

/// The guard of one real robot in a live run: judges by the clock on the wall and the newest sample
/// of the robot's pose, however old the last step of the engine is. One thread.
class LiveGuard {
 public:
  /// A gap between two calls of limit() that is longer than this does not count as longer: after a
  /// pause of the process the robot shall drive again soon.
  static constexpr double kLongestGap_s = 0.5;

  /// `period`: of calls of limit().
  LiveGuard(GuardSpec limits, LivePose pose, std::vector<LiveSensor> sensors, Duration period,
            std::vector<LiveRanges> ranges = {});

  /// The commands that the actuators may get at `now`, by actuator.
  void limit(const GuardOrder& order, SimTime now, std::span<Command> allowed);
  /// The robot was told to stand, past this guard.
  void stand() noexcept { told_ = {}; }
  /// The limits that began to act since the last call, as bits.
  [[nodiscard]] std::uint32_t take_begun() noexcept;
  /// The last sensor that was too old: its index in the robot's type.
  [[nodiscard]] std::uint32_t lost_sensor() const noexcept { return lost_sensor_; }

  /// The last sensor that repeated itself: its index in the robot's type.
  [[nodiscard]] std::uint32_t frozen_sensor() const noexcept { return frozen_sensor_; }

 private:
  void note_gap(SimTime now);
  void look_for_breaks();
  void note_told(double gap_s);
  void take_pose();
  void look_at_ranges();
  void forget_frozen() noexcept;
  void look_where(const GuardOrder& order, SimTime now);
  void look_at_sensors();
  void look_around(const GuardOrder& order, double world_age_s);

  const GuardSpec limits_;
  const LivePose pose_;
  const std::vector<LiveSensor> sensors_;
  const double period_s_;
  RobotGuard guard_;
  PoseTrack track_{from_seconds(1.0)};
  FrozenWatch frozen_pose_;
  std::optional<PoseReading> last_pose_;  ///< As it was read.
  SimTime changed_;  ///< Stamp of the first sample that said what the last one says.
  std::vector<RangeWatch> ranges_;
  Twist2 told_;       ///< The motion that the robot obeys.
  GuardHolds holds_;  ///< Of the last order.
  GuardInput input_;  ///< Without what differs by actuator.
  std::vector<GuardNeighbour> neighbours_;
  std::vector<GuardSensor> ages_;
  std::optional<SimTime> last_call_;
  double gap_s_ = 0;
  std::uint32_t breaks_ = 0;       ///< Of all sensors, until now.
  std::uint32_t pose_breaks_ = 0;  ///< Of the pose, until the newest one.
  std::uint32_t begun_ = 0;
  std::uint32_t lost_sensor_ = 0;
  std::uint32_t frozen_sensor_ = 0;
};

}  // namespace rave::sim
