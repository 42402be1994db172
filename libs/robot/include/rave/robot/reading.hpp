// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"

namespace rave {

/// The type of a sensor's records. The numbers are part of the plug-in interface and of recordings.
enum class ReadingKind : std::uint32_t {
  kNone = 0,
  kRanges = 1,      ///< float metres, one per ray; +infinity is "no return" (REP-117).
  kSightings = 2,   ///< Sighting
  kPose = 3,        ///< PoseReading
  kOdometry = 4,    ///< OdometryReading
  kNeighbours = 5,  ///< NeighbourReading
  kContact = 6,     ///< ContactReading
  kVelocity = 7,    ///< VelocityReading: a commanded or measured velocity.
  kValues = 8,      ///< double; the driver defines the meaning (battery, temperature, ...).
};

/// The name of a kind, as messages and `rave describe` print it.
[[nodiscard]] std::string_view to_string(ReadingKind kind) noexcept;

/// Size of one record of a kind in bytes; 0 for kNone.
[[nodiscard]] std::uint32_t record_size(ReadingKind kind) noexcept;

/// Precedes the records of one sensor of one robot. Records have no padding: their bytes are part
/// of the run hash.
struct SampleHeader {
  std::int64_t stamp_ns = 0;   ///< Simulation time at which the newest record was true.
  std::uint32_t sequence = 0;  ///< Number of the sample, from 1; 0: no sample yet.
  std::uint32_t count = 0;     ///< Number of valid records.
  std::uint32_t fresh = 0;     ///< 1: new since the program's last decision.
  std::uint32_t dropped = 0;   ///< Number of records lost since the last decision for lack of room.
};

/// One barcode or landmark seen by a camera.
struct Sighting {
  std::int64_t stamp_ns = 0;
  std::int32_t code = 0;  ///< The code on the landmark.
  float range_m = 0;      ///< Distance from the sensor to the centre axis of the landmark.
  float bearing_rad = 0;  ///< In the sensor frame, counter-clockwise from its x axis.
  std::uint32_t reserved = 0;
};

/// A pose in the frame of its source (motion capture, indoor positioning, a filter).
struct PoseReading {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double variance_xy_m2 = 0;  ///< Variance of x and of y.
  double variance_yaw_rad2 = 0;
};

/// Pose relative to the start, integrated from wheel motion, and the velocity of the body.
struct OdometryReading {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double v_mps = 0;
  double w_radps = 0;
  double variance_xy_m2 = 0;
  double variance_yaw_rad2 = 0;
};

/// Position and velocity of another robot in the sensor frame.
struct NeighbourReading {
  std::uint32_t robot = 0;  ///< RobotId of the neighbour.
  float range_m = 0;
  float bearing_rad = 0;
  float vx_mps = 0;  ///< Velocity of the neighbour over ground, in the axes of the sensor.
  float vy_mps = 0;
  std::uint32_t reserved = 0;
};

/// Whether the body touches something, and where.
struct ContactReading {
  std::uint32_t touching = 0;
  float bearing_rad = 0;  ///< Direction from the body's centre to the contact, body frame.
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

/// Mounting and properties of a sensor; fixed when the run starts.
struct SensorInfo {
  const char* name = "";
  ReadingKind kind = ReadingKind::kNone;
  std::uint32_t capacity = 0;  ///< Largest number of records; for ranges: the number of rays.
  Pose2 X_RS;                  ///< Mounting pose in the robot frame.
  double z_m = 0;              ///< Height above the floor.
  double period_s = 0;
  /// Samples that are older say nothing about the present: the sensor may have failed. Infinity: it
  /// cannot fall silent, or the rate of its samples is unknown.
  double max_age_s = std::numeric_limits<double>::infinity();
  // Ranges only:
  double range_min_m = 0;
  double range_max_m = 0;
  /// Direction of each of the `capacity` rays in the sensor frame; null for other kinds.
  const double* bearings_rad = nullptr;
  double cone_rad = 0;  ///< Opening angle of a cone sensor; 0 for rays.
};

}  // namespace rave
