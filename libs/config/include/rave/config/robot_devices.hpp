// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "rave/config/described.hpp"
#include "rave/config/shape_file.hpp"

// The devices of a robot as a robot file describes them. Plain values; driver names and parameters
// are checked later against the loaded drivers.
namespace rave::config {

/// Pose of a sensor in the body frame. Nonzero roll and pitch are refused.
struct MountFile {
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;  ///< Height above the floor.
  double yaw_deg = 0;
  double roll_deg = 0;
  double pitch_deg = 0;
  bool operator==(const MountFile&) const = default;
};

/// Errors that are added to every reading; 0 disables each of them.
struct NoiseFile {
  double length_sigma_m = 0;  ///< Standard deviations of Gaussian noise.
  double angle_sigma_deg = 0;
  double velocity_sigma_mps = 0;
  double length_quantum_m = 0;  ///< Quantisation steps that values are rounded to.
  double angle_quantum_deg = 0;
  double velocity_quantum_mps = 0;
  /// Probability, 0 to 1, that a reading (or one of its items) is lost.
  double dropout_probability = 0;
  bool operator==(const NoiseFile&) const = default;
};

/// `median:` of a filter.
struct MedianFilterFile {
  int window = 5;  ///< Number of readings, odd, 1 to 99.
  bool operator==(const MedianFilterFile&) const = default;
};

/// `exponential:` of a filter: a first-order low pass.
struct ExponentialFilterFile {
  double time_constant_s = 0.1;  ///< Greater than 0.
  bool operator==(const ExponentialFilterFile&) const = default;
};

/// One stage of a sensor's filter chain; exactly one member is set.
struct FilterFile {
  std::optional<MedianFilterFile> median;
  std::optional<ExponentialFilterFile> exponential;
  bool operator==(const FilterFile&) const = default;
};

/// What all entries of a robot that a driver serves have in common.
struct NamedDriverFile {
  Located<std::string> name;
  Located<std::string> driver;
  RawNode params;  ///< A mapping or null.
  bool operator==(const NamedDriverFile&) const = default;
};

/// Hardware that sensors and actuators of the robot share.
struct DeviceFile : NamedDriverFile {
  bool operator==(const DeviceFile&) const = default;
};

/// The real or the virtual half of a hybrid sensor. Both halves use the mount of the sensor.
struct SensorHalfFile {
  Located<std::string> driver;
  std::optional<Located<std::string>> device;  ///< Real half: names one of the robot's devices.
  /// Virtual half only; unset: the layers that the real half cannot sense (virtual obstacles,
  /// simulated robots).
  std::optional<Located<std::vector<SensedLayer>>> senses;
  RawNode params;   ///< A mapping or null.
  NoiseFile noise;  ///< Noise of this half alone, added before fusion.
  bool operator==(const SensorHalfFile&) const = default;
};

/// An entry of `sensors:`.
struct SensorFile : NamedDriverFile {
  std::optional<Located<std::string>> device;  ///< Names one of the robot's devices.
  /// Both set for a hybrid sensor, whose driver fuses them.
  std::optional<SensorHalfFile> real;
  std::optional<SensorHalfFile> imagined;  ///< Key `virtual`.
  Located<MountFile> mount;
  /// Unset: the scenario's step. expand_scenario checks that it is a multiple of the step.
  std::optional<Located<double>> period_s;
  Located<double> phase_s = 0.0;  ///< At least 0, less than the period, a multiple of the step.
  /// Unset: the default of the driver's kind (virtual: all layers; hybrid: those that its real half
  /// cannot sense).
  std::optional<Located<std::vector<SensedLayer>>> senses;
  NoiseFile noise;
  double latency_s = 0;
  /// Real sensors and real halves of hybrid ones: the age from which a reading is too old; above 0.
  /// Unset: three periods, but at least 0.2 s.
  std::optional<Located<double>> max_age_s;
  std::vector<FilterFile> filters;
  bool operator==(const SensorFile&) const = default;
};

/// An entry of `actuators:`.
struct ActuatorFile : NamedDriverFile {
  std::optional<Located<std::string>> device;  ///< Names one of the robot's devices.
  bool operator==(const ActuatorFile&) const = default;
};

/// An entry of `controllers:`.
struct ControllerFile : NamedDriverFile {
  Located<std::string> actuator;  ///< Names one of the robot's actuators.
  bool operator==(const ControllerFile&) const = default;
};

/// The device that carries messages of the robot.
struct TransmitterFile : NamedDriverFile {
  std::optional<Located<std::string>> device;  ///< Names one of the robot's devices.
  bool operator==(const TransmitterFile&) const = default;
};

/// The channel through which the program communicates. Robots hear each other if their
/// communicators have the same name.
struct CommunicatorFile : NamedDriverFile {
  Located<std::string> transmitter;  ///< Names one of the robot's transmitters.
  bool operator==(const CommunicatorFile&) const = default;
};

/// What a robot does when no world messages arrive: a virtual wall may have moved meanwhile.
enum class WorldLost { kStop, kSlow, kIgnore };

/// Limits of the guard, which no program can exceed; unset: not limited.
struct GuardFile {
  bool arm = true;  ///< A real robot does not move before it was armed.
  std::optional<double> max_speed_mps;
  std::optional<double> max_turn_dps;
  /// Corners in the world frame, at least 3; the robot's body stays inside.
  std::optional<Located<std::vector<std::array<double, 2>>>> fence_m;
  std::optional<double> separation_m;  ///< Least distance to the bodies of other robots.
  WorldLost world_lost = WorldLost::kStop;
  double world_timeout_s = 0.5;
  double slow_speed_mps = 0.05;    ///< Speed limit for kSlow.
  double deceleration_mps2 = 0.5;  ///< The deceleration that the robot achieves at least.
  double reaction_s = 0.1;         ///< Delay between a command and its effect.
  double watchdog_s = 1;  ///< Commands of the program that are older than this are ignored.
  double frozen_s = 0.5;  ///< Beyond `reaction_s`: how long a sensor may repeat itself; 0: always.
  double must_see_deg = 45;  ///< To each side of where it drives; 0: it need not see.
  bool operator==(const GuardFile&) const = default;
};

/// The decision process.
struct ProgramFile {
  Located<std::string> driver;
  std::optional<Located<double>> period_s;  ///< Unset: the scenario's step.
  Located<double> phase_s = 0.0;
  bool isolate = false;  ///< Whether it runs in a process of its own.
  RawNode params;        ///< A mapping or null.
  bool operator==(const ProgramFile&) const = default;
};

}  // namespace rave::config
