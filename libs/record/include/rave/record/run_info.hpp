// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/math/pose.hpp"
#include "rave/record/attached_files.hpp"
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

/// A sensor of a recorded robot, with the data needed to interpret its readings.
struct RecordedSensor {
  RobotId robot;
  DeviceId sensor;
  std::string name;
  std::uint32_t kind = 0;  ///< A number of rave::ReadingKind.
  Pose2 X_RS;              ///< Mounting pose in the robot frame.
  double z_m = 0;
  double period_s = 0;
  double range_min_m = 0;
  double range_max_m = 0;
  double cone_rad = 0;
  std::vector<double> bearings_rad;  ///< Bearings of the rays; empty for other kinds.
  /// Whether it senses the virtual world alone; hybrids are in kHybridMetadata. False in recordings
  /// that do not have it.
  bool is_virtual = false;

  friend bool operator==(const RecordedSensor&, const RecordedSensor&) = default;
};

/// Metadata with the hybrid sensors of a run: `robot/sensor` to a description of its parts.
inline constexpr const char* kHybridMetadata = "rave.hybrid";

// Metadata of the recordings of a run with several processes: the host (`name`; `world` for the
// world authority), and the robots of each host in the format of robot_ranges().
inline constexpr const char* kHostMetadata = "rave.host";
inline constexpr const char* kHostsMetadata = "rave.hosts";
/// Metadata of a merged recording: the state of each of its parts.
inline constexpr const char* kPartsMetadata = "rave.parts";

/// The content of the first message of a recording.
struct RunInfo {
  std::string scenario;
  std::string started;  ///< Wall time of the start, ISO 8601, UTC; informative.
  std::uint64_t seed = 0;
  double step_s = 0;
  StringMap versions;  ///< Of RAVE, drivers, programs: name to version.
  std::vector<RecordedRobot> robots;
  std::vector<RecordedSensor> sensors;
  std::string expanded_scenario;  ///< YAML; becomes the attachment `scenario.yaml`.
  /// Files outside of the scenario that the run depends on (maps, recordings): absolute path to
  /// SHA-256 in hexadecimal. Stored as the metadata `rave.inputs`.
  StringMap inputs;
  /// Those of them that are inside the recording. Empty when it is read: see
  /// read_attached_files().
  AttachedFiles files;
};

}  // namespace rave::record
