// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/math/pose.hpp"
#include "rave/record/mcap_types.hpp"

namespace rave::record {

/// A robot of a recorded run. Its id is its index in the expanded scenario.
struct RecordedRobot {
  RobotId id;
  std::string name;
  std::string kind;  ///< `simulated`, `real`, `recorded`, ...
  std::string team;

  friend bool operator==(const RecordedRobot&, const RecordedRobot&) = default;
};

/// A sensor of a recorded robot: what a reader needs to make sense of its readings.
struct RecordedSensor {
  RobotId robot;
  DeviceId sensor;
  std::string name;
  std::uint32_t kind = 0;  ///< Number of rave::ReadingKind.
  Pose2 X_RS;              ///< Mounting pose in the robot's frame.
  double z_m = 0;
  double period_s = 0;
  double range_min_m = 0;
  double range_max_m = 0;
  double cone_rad = 0;
  std::vector<double> bearings_rad;  ///< Of the rays; empty for other kinds.

  friend bool operator==(const RecordedSensor&, const RecordedSensor&) = default;
};

/// Metadata that names the hybrid sensors of a run, `robot/sensor`, and says what each is made of.
inline constexpr const char* kHybridMetadata = "rave.hybrid";

// The records of a run of several processes say whose they are (`name`; of the authority of the
// world `world`), and which robots each host runs, as robot_ranges().
inline constexpr const char* kHostMetadata = "rave.host";
inline constexpr const char* kHostsMetadata = "rave.hosts";
/// Of a record that was put together of several: what became of each of them.
inline constexpr const char* kPartsMetadata = "rave.parts";

/// What stands at the beginning of a record.
struct RunInfo {
  std::string scenario;
  std::string started;  ///< Wall time of the start, ISO 8601, UTC; for people.
  std::uint64_t seed = 0;
  double step_s = 0;
  StringMap versions;  ///< Of RAVE, drivers, programs: name to version.
  std::vector<RecordedRobot> robots;
  std::vector<RecordedSensor> sensors;
  std::string expanded_scenario;  ///< YAML; becomes the attachment `scenario.yaml`.
  /// Files outside of the scenario that the run depends on (maps, recordings): absolute path to
  /// SHA-256 in hexadecimal digits. Becomes the metadata `rave.inputs`.
  StringMap inputs;
};

}  // namespace rave::record
