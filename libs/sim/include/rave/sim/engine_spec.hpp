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
#include "rave/sim/conductor.hpp"
#include "rave/sim/driver_spec.hpp"
#include "rave/sim/guard.hpp"
#include "rave/sim/hand_over.hpp"
#include "rave/sim/obstacle_change.hpp"
#include "rave/sim/parameter_change.hpp"
#include "rave/sim/phase_clock.hpp"
#include "rave/sim/radio.hpp"
#include "rave/sim/virtual_sensor.hpp"
#include "rave/world/body.hpp"

namespace rave::sim {

/// A decision process in an operating-system process of its own. One object per robot. begin() of
/// many may be called before their end(), so that they decide in parallel. After an error the
/// program is not called again.
class ProgramProcess {
 public:
  virtual ~ProgramProcess() = default;
  virtual Status begin(const DecideItem& item) = 0;
  virtual Status end(const DecideItem& item) = 0;
  /// New values of all parameters and a new radius of the body, between two decisions. An error
  /// refuses the change; the old values remain.
  virtual Status update(std::span<const ParamValue> /*params*/, double /*radius_m*/) {
    return fail(ErrorCode::kInvalidArgument, kTakesNoParameters);
  }
};
using ProgramProcessFactory =
    std::function<Result<std::unique_ptr<ProgramProcess>>(const ProgramSetup&)>;

/// Hardware that sensors and actuators of a robot share.
struct DeviceSpec : DriverSpec {
  const HardwareDeviceOps* ops = nullptr;
};

/// The additional parts of a hybrid sensor: the virtual half, and the driver that fuses both
/// halves.
struct HybridSpec {
  const HybridSensorOps* ops = nullptr;
  plugin::ParamSet params;  ///< Parameters of the driver that fuses.
  std::string real_driver;
  NoiseSpec real_noise;  ///< Noise of the real half, added before fusion.
  std::string virtual_driver;
  const VirtualSensorOps* virtual_ops = nullptr;
  plugin::ParamSet virtual_params;
  NoiseSpec virtual_noise;  ///< Noise of the virtual half, added before fusion.
};

/// One sensor of a robot type. Exactly one of the two ops is set. With `hybrid`, hardware_ops and
/// `params` are those of the real half, `layers` those of the virtual half, and `driver` names the
/// driver that fuses.
struct SensorSpec : DriverSpec {
  ReadingKind kind = ReadingKind::kNone;
  const VirtualSensorOps* virtual_ops = nullptr;
  const HardwareSensorOps* hardware_ops = nullptr;
  std::optional<std::uint32_t> device;  ///< Hardware: index into RobotType::devices.
  Pose2 X_RS;
  double z_m = 0;
  std::uint32_t period_steps = 1;
  std::uint32_t phase_steps = 0;
  LayerMask layers = kAllLayers;
  /// Hardware: when its samples arrive, and the age in seconds after which it counts as lost.
  /// Unset: see sensor_age.hpp.
  SampleTiming timing = SampleTiming::kUnknown;
  std::optional<double> max_age_s;
  ProcessingSpec processing;
  std::optional<HybridSpec> hybrid;

  /// Name of the driver of `hardware_ops`.
  [[nodiscard]] const std::string& hardware_driver() const noexcept {
    return hybrid ? hybrid->real_driver : driver;
  }
};

/// The virtual half of a hybrid sensor as a separate sensor without a device, for pictures. Other
/// sensors are returned unchanged.
[[nodiscard]] SensorSpec virtual_half_of(SensorSpec sensor);

struct ControllerSpec : DriverSpec {
  const ControllerOps* ops = nullptr;
  CommandKind accepts = CommandKind::kNone;
  std::uint32_t actuator = 0;  ///< Index into RobotType::actuators.
  /// The parameters that may change during a run; valid as long as `ops`.
  std::span<const ParamSpec> param_specs;
};

/// One actuator. Exactly one of the two ops is set.
struct ActuatorSpec : DriverSpec {
  const VirtualActuatorOps* virtual_ops = nullptr;
  const HardwareActuatorOps* hardware_ops = nullptr;
  std::optional<std::uint32_t> device;  ///< Hardware: index into RobotType::devices.
  /// The parameters that may change during a run; valid as long as `ops`.
  std::span<const ParamSpec> param_specs;
};

struct ProgramSpec {
  std::string driver;
  const ProgramOps* ops = nullptr;  ///< May be null if `isolate` is set.
  plugin::ParamSet params;
  std::uint32_t period_steps = 1;
  std::uint32_t phase_steps = 0;
  /// If set, the program of each robot runs in a process of its own.
  ProgramProcessFactory isolate;
  /// The parameters that may change during a run; valid as long as `ops`.
  std::span<const ParamSpec> param_specs;
  SourceLocation where{};  ///< Of its driver in the robot file, for errors.

  /// The orders that the program accepts.
  [[nodiscard]] OrderSet takes() const { return ops == nullptr ? 0 : ops->takes; }
};

/// Robots from one file with equal variables: they share drivers and parameters.
struct RobotType {
  std::string name;
  std::string folder;     ///< Folder of the robot file, the base of relative paths in parameters.
  bool simulated = true;  ///< Whether it has a true pose; otherwise it has a reported pose only.
  std::vector<DeviceSpec> devices;
  std::vector<SensorSpec> sensors;
  std::vector<ControllerSpec> controllers;
  std::vector<ActuatorSpec> actuators;
  std::vector<TransmitterSpec> transmitters;
  std::vector<CommunicatorSpec> communicators;
  std::optional<ProgramSpec> program;
  /// Index of the sensor that reports the pose; unset: the true pose (simulated robots only).
  std::optional<std::uint32_t> pose_from;
  std::optional<Pose2> X_WM;  ///< X_WM, the pose of that sensor's frame M; unset: the start pose
                              ///< for odometry, else W.
  Duration staleness = from_seconds(0.5);  ///< A reported pose older than this is stale.
  /// Speeds beyond which a pose from hardware is not believed; unset: the limits of the guard, else
  /// what no robot of its sort exceeds.
  std::optional<double> pose_max_speed_mps;
  std::optional<double> pose_max_turn_radps;
  /// Limits of the guard. A real robot that executes commands has at least those of GuardSpec{}.
  std::optional<GuardSpec> guard;
};

/// The largest pose difference at which a hand-over is accepted.
struct HandOverLimits {
  double within_m = 0.25;
  double within_rad = deg_to_rad(20);
};

struct RobotSpec {
  std::string name;
  std::string team;
  std::uint32_t type = 0;
  Pose2 X_WR;  ///< Start pose of a simulated robot.
  /// Index of another type whose sensors, actuators and devices may serve the robot instead. Its
  /// sensors and actuators have the same names and kinds in the same order, and it has the same
  /// controllers and program. No other robot may use either type.
  ///
  /// In an engine `type` is always the active one, and `twin` the other.
  std::optional<std::uint32_t> twin = std::nullopt;
  HandOverLimits hand_over = {};
};

/// The complete input of an Engine. Robots are in the order of their ids, as in `world.robots`.
struct EngineSpec {
  world::WorldModel world;
  std::vector<RobotType> types;
  std::vector<RobotSpec> robots;
  Duration step = from_seconds(0.01);
  std::uint64_t seed = 1;
  unsigned threads = 1;
  /// How far back sample_at() and hybrid sensors can look; zero if not needed. At least 1 s if a
  /// robot has a hybrid sensor.
  Duration history = {};
  /// Wall clock of a live run; null for a stepped one. Not owned.
  const RunClock* live_clock = nullptr;
  /// Live runs: the period at which the guard of a real robot writes to its actuators, wall time:
  /// above 0, and well below the watchdogs of drivers and devices.
  Duration guard_period = from_seconds(0.02);
  /// Called whenever everything but the sensors is open. The clock of a live run starts here, so
  /// that the time to open devices is not part of the run. May be empty.
  std::function<void()> on_ready;
  /// With several hosts: called in Engine::propose() when the step is complete, before hardware
  /// samples for the next one are read. At this point observers see the state that they see between
  /// two steps of a single engine. May be empty.
  std::function<void()> on_step_done;
  /// Longest wall time for which a stepped hardware driver may block before the run is aborted.
  std::chrono::milliseconds host_timeout{10'000};
  /// Longest wall time that the destructor of an engine waits for drivers to close (after the
  /// first, at most one second for each), and for unfinished hand-overs. Drivers that need longer
  /// are abandoned: the log names them, and their threads, their plug-ins and the memory of the
  /// engine stay until the process ends.
  std::chrono::milliseconds last_wait{5'000};
  /// Called for each abandoned driver with an address of its code, which must stay loaded until the
  /// process ends. Null: the code stays loaded anyway.
  void (*keep_loaded)(const void* within) = nullptr;
  /// Changes of parameters that are part of the run, by step.
  std::vector<ScheduledChange> changes;
  /// Changes of obstacles that are part of the run, by step.
  std::vector<ScheduledObstacle> obstacle_changes;
  /// Hand-overs that are part of the run, by step.
  std::vector<ScheduledHandOver> hand_overs;
  /// What happens on conditions; null: nothing. One of several hosts never asks it.
  std::shared_ptr<Conductor> conductor;
  /// Not owned; outlives the engine.
  LogSink* log = nullptr;
  /// If set, phase_times() measures the phases. Never affects results.
  PhaseClock phase_clock = nullptr;
  /// Distributes every loop over the threads, even if that is slower; for tests that threads do not
  /// change results.
  bool share_always = false;
  /// If set, the engine is one of several hosts and runs these robots only (at least one, without
  /// duplicates). Types without local robots need no function tables. Such a run is stepped, and
  /// transmitters work in process, unless own_authority is set. Unset: all robots.
  std::optional<std::vector<RobotId>> local;
  /// With `local`: the caller of propose() and apply() has a WorldAuthority of its own, which
  /// places the robots of other hosts at their reported poses, so that no host waits for another.
  /// Such a run may be live; apply() then also reads the hardware samples since propose().
  bool own_authority = false;
};

}  // namespace rave::sim
