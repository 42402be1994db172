// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"

namespace rave {

/// What the records of a sensor are. The number is part of the plug-in interface and of records.
enum class ReadingKind : std::uint32_t {
  kNone = 0,
  kRanges = 1,      ///< float metres, one per ray; +infinity is "no return" (REP-117).
  kSightings = 2,   ///< Sighting
  kPose = 3,        ///< PoseReading
  kOdometry = 4,    ///< OdometryReading
  kNeighbours = 5,  ///< NeighbourReading
  kContact = 6,     ///< ContactReading
  kVelocity = 7,    ///< VelocityReading: a commanded or measured velocity.
  kValues = 8,      ///< double, meaning said by the driver (battery, temperature, ...).
};

/// The name of a kind, as messages and `rave describe` print it.
[[nodiscard]] std::string_view to_string(ReadingKind kind) noexcept;

/// Bytes of one record of a kind; 0 for kNone.
[[nodiscard]] std::uint32_t record_size(ReadingKind kind) noexcept;

/// Stands before the records of one sensor of one robot. Records have no padding: their bits are
/// part of the run hash.
struct SampleHeader {
  std::int64_t stamp_ns = 0;   ///< When the newest record was true, simulation time.
  std::uint32_t sequence = 0;  ///< Counts samples from 1; 0: nothing has come yet.
  std::uint32_t count = 0;     ///< Records that are valid.
  std::uint32_t fresh = 0;     ///< 1: came since the program's last decision.
  std::uint32_t dropped = 0;   ///< Records that did not fit since the last decision.
};

/// One barcode or landmark seen by a camera.
struct Sighting {
  std::int64_t stamp_ns = 0;
  std::int32_t code = 0;  ///< What is printed on the landmark.
  float range_m = 0;      ///< From the sensor to the landmark's centre axis.
  float bearing_rad = 0;  ///< In the sensor frame, counter-clockwise from its x axis.
  std::uint32_t reserved = 0;
};

/// A pose in the frame of its source (motion capture, indoor positioning, a filter).
struct PoseReading {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double variance_xy_m2 = 0;  ///< Of each of x and y.
  double variance_yaw_rad2 = 0;
};

/// Pose since start as integrated from the wheels, and the velocity of the body.
struct OdometryReading {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double v_mps = 0;
  double w_radps = 0;
  double variance_xy_m2 = 0;
  double variance_yaw_rad2 = 0;
};

/// Where another robot is and how it moves, all in the sensor frame.
struct NeighbourReading {
  std::uint32_t robot = 0;  ///< RobotId of the neighbour.
  float range_m = 0;
  float bearing_rad = 0;
  float vx_mps = 0;  ///< Velocity of the neighbour over ground, axes of the sensor.
  float vy_mps = 0;
  std::uint32_t reserved = 0;
};

/// Whether and where the body touches something.
struct ContactReading {
  std::uint32_t touching = 0;
  float bearing_rad = 0;  ///< From the body's centre to the contact, body frame.
};

/// A velocity of the body, in its own frame.
struct VelocityReading {
  double v_mps = 0;
  double w_radps = 0;
};

static_assert(sizeof(Sighting) == 24 && sizeof(PoseReading) == 40 &&
              sizeof(OdometryReading) == 56 && sizeof(NeighbourReading) == 24 &&
              sizeof(ContactReading) == 8 && sizeof(VelocityReading) == 16 &&
              sizeof(SampleHeader) == 24);

/// Where a sensor sits on its robot and what it gives; fixed when the run starts.
struct SensorInfo {
  const char* name = "";
  ReadingKind kind = ReadingKind::kNone;
  std::uint32_t capacity = 0;  ///< Records at most; for ranges: the number of rays.
  Pose2 X_RS;                  ///< Mounting pose in the robot's frame.
  double z_m = 0;              ///< Height above the floor.
  double period_s = 0;
  /// A sample that is older says nothing of the present: the sensor may be dead. Infinity: it
  /// cannot fall silent, or nobody knows how often its samples come.
  double max_age_s = std::numeric_limits<double>::infinity();
  // Ranges only:
  double range_min_m = 0;
  double range_max_m = 0;
  /// Direction of each ray in the sensor frame, `capacity` of them; null for other kinds.
  const double* bearings_rad = nullptr;
  double cone_rad = 0;  ///< Opening of a cone sensor; 0 for rays.
};

}  // namespace rave
