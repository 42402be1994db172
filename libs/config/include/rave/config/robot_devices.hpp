// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "rave/config/located.hpp"
#include "rave/config/raw_node.hpp"
#include "rave/config/shape_file.hpp"

// What a robot file says of the devices of a robot. Plain values; driver names and parameters are
// checked later against the drivers that are loaded.
namespace rave::config {

/// Pose of a sensor in the body frame. Roll and pitch other than 0 are refused.
struct MountFile {
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;  ///< Height above the floor.
  double yaw_deg = 0;
  double roll_deg = 0;
  double pitch_deg = 0;
  bool operator==(const MountFile&) const = default;
};

/// Errors that are put on every reading; 0 switches each of them off.
struct NoiseFile {
  double length_sigma_m = 0;  ///< Standard deviations of Gaussian noise.
  double angle_sigma_deg = 0;
  double velocity_sigma_mps = 0;
  double length_quantum_m = 0;  ///< Steps that values are rounded to.
  double angle_quantum_deg = 0;
  double velocity_quantum_mps = 0;
  double dropout_probability = 0;  ///< 0 to 1; that a reading (or one of its items) is lost.
  bool operator==(const NoiseFile&) const = default;
};

/// `median:` of a filter.
struct MedianFilterFile {
  int window = 5;  ///< Readings, odd, 1 to 99.
  bool operator==(const MedianFilterFile&) const = default;
};

/// `exponential:` of a filter: a first-order low pass.
struct ExponentialFilterFile {
  double time_constant_s = 0.1;  ///< Greater than 0.
  bool operator==(const ExponentialFilterFile&) const = default;
};

/// One stage of a sensor's processing chain; exactly one is set.
struct FilterFile {
  std::optional<MedianFilterFile> median;
  std::optional<ExponentialFilterFile> exponential;
  bool operator==(const FilterFile&) const = default;
};

/// Hardware that sensors and actuators of the robot share.
struct DeviceFile {
  Located<std::string> name;
  Located<std::string> driver;
  RawNode params;  ///< A mapping or null.
  bool operator==(const DeviceFile&) const = default;
};

/// The real or the virtual half of a hybrid sensor; it sits where the sensor does.
struct SensorHalfFile {
  Located<std::string> driver;
  std::optional<Located<std::string>> device;  ///< Real half: names one of the robot's devices.
  /// Virtual half; unset: what the real half cannot see (virtual obstacles, simulated robots).
  std::optional<Located<std::vector<SensedLayer>>> senses;
  RawNode params;   ///< A mapping or null.
  NoiseFile noise;  ///< Of this half alone, before fusion.
  bool operator==(const SensorHalfFile&) const = default;
};

/// An entry of `sensors:`.
struct SensorFile {
  Located<std::string> name;
  Located<std::string> driver;
  std::optional<Located<std::string>> device;  ///< Names one of the robot's devices.
  /// Both set: a hybrid sensor, whose driver fuses them.
  std::optional<SensorHalfFile> real;
  std::optional<SensorHalfFile> imagined;  ///< Key `virtual`.
  Located<MountFile> mount;
  /// Unset: the scenario's step. expand_scenario checks that it is a multiple of that.
  std::optional<Located<double>> period_s;
  Located<double> phase_s = 0.0;  ///< At least 0, less than the period, a multiple of the step.
  /// Unset: the default of the driver's kind (virtual: all; hybrid: what its real half cannot see).
  std::optional<Located<std::vector<SensedLayer>>> senses;
  RawNode params;  ///< A mapping or null.
  NoiseFile noise;
  double latency_s = 0;
  /// Real sensors, the real half of hybrid ones: above 0; unset: three periods, at least 0.2 s.
  std::optional<Located<double>> max_age_s;
  std::vector<FilterFile> filters;
  bool operator==(const SensorFile&) const = default;
};

/// An entry of `actuators:`.
struct ActuatorFile {
  Located<std::string> name;
  Located<std::string> driver;
  std::optional<Located<std::string>> device;  ///< Names one of the robot's devices.
  RawNode params;                              ///< A mapping or null.
  bool operator==(const ActuatorFile&) const = default;
};

/// An entry of `controllers:`.
struct ControllerFile {
  Located<std::string> name;
  Located<std::string> driver;
  Located<std::string> actuator;  ///< Names one of the robot's actuators.
  RawNode params;                 ///< A mapping or null.
  bool operator==(const ControllerFile&) const = default;
};

/// What carries messages out of the robot.
struct TransmitterFile {
  Located<std::string> name;
  Located<std::string> driver;
  std::optional<Located<std::string>> device;  ///< Names one of the robot's devices.
  RawNode params;                              ///< A mapping or null.
  bool operator==(const TransmitterFile&) const = default;
};

/// Through which the program talks; robots whose communicators have the same name hear each other.
struct CommunicatorFile {
  Located<std::string> name;
  Located<std::string> driver;
  Located<std::string> transmitter;  ///< Names one of the robot's transmitters.
  RawNode params;                    ///< A mapping or null.
  bool operator==(const CommunicatorFile&) const = default;
};

/// What a robot does when the virtual world stops coming: a frozen wall must not read as free.
enum class WorldLost { kStop, kSlow, kIgnore };

/// Limits that no program can pass; null: not limited.
struct GuardFile {
  bool arm = true;  ///< A real robot stands until somebody arms it.
  std::optional<double> max_speed_mps;
  std::optional<double> max_turn_dps;
  /// Corners in the world, at least 3; the robot's body stays inside.
  std::optional<Located<std::vector<std::array<double, 2>>>> fence_m;
  std::optional<double> separation_m;  ///< Least distance to the bodies of other robots.
  WorldLost world_lost = WorldLost::kStop;
  double world_timeout_s = 0.5;
  double slow_speed_mps = 0.05;    ///< For kSlow.
  double deceleration_mps2 = 0.5;  ///< What the robot surely brakes with.
  double reaction_s = 0.1;         ///< From a command until it obeys.
  double watchdog_s = 1;           ///< Older commands of the program are none.
  bool operator==(const GuardFile&) const = default;
};

/// The decision process.
struct ProgramFile {
  Located<std::string> driver;
  std::optional<Located<double>> period_s;  ///< Unset: the scenario's step.
  Located<double> phase_s = 0.0;
  bool isolate = false;  ///< In a process of its own.
  RawNode params;        ///< A mapping or null.
  bool operator==(const ProgramFile&) const = default;
};

}  // namespace rave::config
