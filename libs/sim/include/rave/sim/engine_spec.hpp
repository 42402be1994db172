// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/math/scalar.hpp"
#include "rave/plugin/param_set.hpp"
#include "rave/robot/actuator.hpp"
#include "rave/robot/controller.hpp"
#include "rave/robot/device.hpp"
#include "rave/robot/hardware_sensor.hpp"
#include "rave/robot/hybrid_sensor.hpp"
#include "rave/robot/processing.hpp"
#include "rave/robot/program.hpp"
#include "rave/robot/sample_queue.hpp"
#include "rave/sim/guard.hpp"
#include "rave/sim/hand_over.hpp"
#include "rave/sim/obstacle_change.hpp"
#include "rave/sim/parameter_change.hpp"
#include "rave/sim/phase_clock.hpp"
#include "rave/sim/radio.hpp"
#include "rave/sim/virtual_sensor.hpp"
#include "rave/world/body.hpp"

namespace rave::sim {

/// A program in a process of its own. One object per robot; begin() of many may come before their
/// end(), so that they decide at the same time. After an error the program is not asked again.
class ProgramProcess {
 public:
  virtual ~ProgramProcess() = default;
  virtual Status begin(const DecideItem& item) = 0;
  virtual Status end(const DecideItem& item) = 0;
  /// New values of all parameters and a new radius of the body, between two decisions. An error:
  /// the program refuses and goes on with the old ones.
  virtual Status update(std::span<const ParamValue> /*params*/, double /*radius_m*/) {
    return fail(ErrorCode::kInvalidArgument, "it takes no new parameters while it runs");
  }
};
using ProgramProcessFactory =
    std::function<Result<std::unique_ptr<ProgramProcess>>(const ProgramSetup&)>;

/// Hardware that sensors and actuators of a robot share.
struct DeviceSpec {
  std::string name;
  std::string driver;
  const HardwareDeviceOps* ops = nullptr;
  plugin::ParamSet params;
};

/// What makes a hybrid of a real sensor: the virtual half, and the driver that makes one reading of
/// both.
struct HybridSpec {
  const HybridSensorOps* ops = nullptr;
  plugin::ParamSet params;  ///< Of the driver that fuses.
  std::string real_driver;
  NoiseSpec real_noise;  ///< Put on the real half alone, before fusion.
  std::string virtual_driver;
  const VirtualSensorOps* virtual_ops = nullptr;
  plugin::ParamSet virtual_params;
  NoiseSpec virtual_noise;  ///< Put on the virtual half alone, before fusion.
};

/// One sensor of a type of robot. Exactly one of the two ops is set. With `hybrid` set it is that
/// of the hardware, which with `params` is the real half; `layers` are those of the virtual half,
/// and `driver` names the one that fuses.
struct SensorSpec {
  std::string name;
  std::string driver;
  ReadingKind kind = ReadingKind::kNone;
  const VirtualSensorOps* virtual_ops = nullptr;
  const HardwareSensorOps* hardware_ops = nullptr;
  std::optional<std::uint32_t> device;  ///< Hardware: index into RobotType::devices.
  plugin::ParamSet params;
  Pose2 X_RS;
  double z_m = 0;
  std::uint32_t period_steps = 1;
  std::uint32_t phase_steps = 0;
  LayerMask layers = kAllLayers;
  /// Hardware: when its samples come, and the age after which it counts as lost, seconds. Not set:
  /// see sensor_age.hpp.
  SampleTiming timing = SampleTiming::kUnknown;
  std::optional<double> max_age_s;
  ProcessingSpec processing;
  std::optional<HybridSpec> hybrid;

  /// The driver that `hardware_ops` belong to.
  [[nodiscard]] const std::string& hardware_driver() const noexcept {
    return hybrid ? hybrid->real_driver : driver;
  }
};

/// The virtual half of a hybrid sensor as a sensor by itself, for pictures: no device is needed.
/// Any other sensor stays what it is.
[[nodiscard]] SensorSpec virtual_half_of(SensorSpec sensor);

struct ControllerSpec {
  std::string name;
  std::string driver;
  const ControllerOps* ops = nullptr;
  plugin::ParamSet params;
  CommandKind accepts = CommandKind::kNone;
  std::uint32_t actuator = 0;  ///< Index into RobotType::actuators.
  /// What may be changed while the run goes; lives as long as `ops`.
  std::span<const ParamSpec> param_specs;
};

/// One actuator. Exactly one of the two ops is set.
struct ActuatorSpec {
  std::string name;
  std::string driver;
  const VirtualActuatorOps* virtual_ops = nullptr;
  const HardwareActuatorOps* hardware_ops = nullptr;
  std::optional<std::uint32_t> device;  ///< Hardware: index into RobotType::devices.
  plugin::ParamSet params;
  /// What may be changed while the run goes; lives as long as `ops`.
  std::span<const ParamSpec> param_specs;
};

struct ProgramSpec {
  std::string driver;
  const ProgramOps* ops = nullptr;  ///< May be null if `isolate` is set.
  plugin::ParamSet params;
  std::uint32_t period_steps = 1;
  std::uint32_t phase_steps = 0;
  ProgramProcessFactory isolate;  ///< Set: each robot's program gets a process of its own.
  /// What may be changed while the run goes; lives as long as `ops`.
  std::span<const ParamSpec> param_specs;

  /// The orders that the program accepts.
  [[nodiscard]] OrderSet takes() const { return ops == nullptr ? 0 : ops->takes; }
};

/// Robots that came from one file with the same variables: they share drivers and parameters.
struct RobotType {
  std::string name;
  std::string folder;     ///< Of the robot file; relative paths of drivers start there.
  bool simulated = true;  ///< Has a true pose; otherwise only a reported one.
  std::vector<DeviceSpec> devices;
  std::vector<SensorSpec> sensors;
  std::vector<ControllerSpec> controllers;
  std::vector<ActuatorSpec> actuators;
  std::vector<TransmitterSpec> transmitters;
  std::vector<CommunicatorSpec> communicators;
  std::optional<ProgramSpec> program;
  /// The sensor that says where the robot is; none: the truth (simulated robots only).
  std::optional<std::uint32_t> pose_from;
  std::optional<Pose2> X_WM;  ///< Frame of that sensor; none: the start pose for odometry, else W.
  Duration staleness = from_seconds(0.5);  ///< A reported pose older than this is stale.
  /// Limits below the program. A real robot that obeys has those of GuardSpec{} at least.
  std::optional<GuardSpec> guard;
};

/// How far the pose of a robot may jump in a hand-over; farther, and it is refused.
struct HandOverLimits {
  double within_m = 0.25;
  double within_rad = deg_to_rad(20);
};

struct RobotSpec {
  std::string name;
  std::string team;
  std::uint32_t type = 0;
  Pose2 X_WR;  ///< Where a simulated robot starts.
  /// Of an engine: `type` is the one that serves the robot now, `twin` the other.
  ///
  /// Another type whose sensors, actuators and devices may serve the robot instead: sensors and
  /// actuators of the same names and kinds in the same order, the same controllers and program.
  /// Both types are this robot's alone.
  std::optional<std::uint32_t> twin = std::nullopt;
  HandOverLimits hand_over = {};
};

/// Everything an Engine is made from. Robots are in the order of their ids, which is also the order
/// of `world.robots`.
struct EngineSpec {
  world::WorldModel world;
  std::vector<RobotType> types;
  std::vector<RobotSpec> robots;
  Duration step = from_seconds(0.01);
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// How far sample_at() and hybrid sensors can look back; zero if it is not needed. At least 1 s
  /// if a robot has a hybrid sensor.
  Duration history = {};
  /// Wall clock of a live run; null for a stepped one. Not owned.
  const RunClock* live_clock = nullptr;
  /// How often the guard of a real robot that obeys writes to its actuators in a live run, wall
  /// time: above 0, and well below the watchdogs of drivers and devices.
  Duration guard_period = from_seconds(0.02);
  /// Called each time that all is open but the sensors: a live run's clock starts here, so that
  /// what it took to find the devices is no part of the run. May be empty.
  std::function<void()> on_ready;
  /// One of several hosts: called in Engine::propose() when the step is done, before hardware is
  /// asked for the next one. Here alone observers find what they find between two steps of an
  /// engine that is alone. May be empty.
  std::function<void()> on_step_done;
  /// How long a stepped hardware driver may take, wall time, before the run is given up.
  std::chrono::milliseconds host_timeout{10'000};
  /// How long the end of an engine waits, wall time, for a driver that it closes (a second at most
  /// for each after the first of them), and for those of a hand-over that are still under way. What
  /// is not done then is left behind: the log is told which, and the thread, its plug-in and the
  /// memory of the engine stay until the process ends.
  std::chrono::milliseconds last_wait{5'000};
  /// Called at such an end with an address within each of these drivers: its code must stay loaded
  /// for as long as the process runs. Null: it does so anyway.
  void (*keep_loaded)(const void* within) = nullptr;
  /// Changes of parameters that belong to the run, by step.
  std::vector<ScheduledChange> changes;
  /// Obstacles that come, move and go as a part of the run, by step.
  std::vector<ScheduledObstacle> obstacle_changes;
  /// Robots that change their drivers as a part of the run, by step.
  std::vector<ScheduledHandOver> hand_overs;
  /// Not owned; outlives the engine.
  LogSink* log = nullptr;
  /// Set: phase_times() tells what the phases took. No part of any result.
  PhaseClock phase_clock = nullptr;
  /// Shares every loop among the threads, also where one of them would be done sooner: for tests
  /// of what threads must not change.
  bool share_always = false;
  /// Set: the engine is one of several hosts of a world and runs these robots alone (at least one,
  /// each once). Types that no local robot is of need no function tables. Unless it is its own
  /// authority, such a run is stepped, and transmitters work in process. Not set: all robots.
  std::optional<std::vector<RobotId>> local;
  /// With `local`: whoever calls propose() and apply() has a WorldAuthority of his own, in which
  /// the robots of other hosts are put where they are said to be, so nobody waits for anybody. Such
  /// a run may be live, and apply() takes in what hardware has said since propose().
  bool own_authority = false;
};

}  // namespace rave::sim
