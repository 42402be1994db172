// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "rave/math/geodesy.hpp"
#include "rave/math/pose.hpp"
#include "rave/robot/reading.hpp"
#include "rave/ros2/messages.hpp"
#include "ros2/ros2_options.hpp"

namespace rave::ros2_driver {

/// Makes the frame of the world from latitude and longitude in degrees and, if given, altitude in
/// metres and the yaw of the world's x axis from east in degrees. Error kInvalidArgument.
[[nodiscard]] Result<GeoFrame> read_geo_origin(std::span<const double> numbers);

struct GpsOptions {
  Doubt doubt;                   ///< Used if a message has no covariance.
  double course_distance_m = 0;  ///< Least distance between two fixes that gives a heading.
  Vec2 antenna_m;                ///< Position of the antenna in the body frame.
  bool has_imu = false;          ///< Whether the heading comes from an inertial unit.
};

/// The pose of a robot in the world from the fixes of its receiver. A receiver gives no heading: it
/// comes from an inertial unit, or from the direction of travel of the antenna. A value; messages
/// must have passed ros2::validate(). One thread at a time.
class GpsTrack {
 public:
  GpsTrack(const GeoFrame& frame, const GpsOptions& options) : frame_(frame), options_(options) {}

  /// Adds an orientation. Error kInvalidArgument: the message has none, or no stamp.
  Status hear(const ros2::Imu& message);
  /// The pose for a fix. Errors: kState (no fix; no heading yet, or one more than a second old),
  /// kInvalidArgument (too far from the origin of the world; no stamp, but an inertial unit).
  [[nodiscard]] Result<PoseReading> take(const ros2::NavSatFix& message);
  /// The stamp of the pose for a fix: that of the fix or of the orientation, whichever is older. 0:
  /// none.
  [[nodiscard]] std::int64_t stamp_ns(const ros2::NavSatFix& message) const noexcept;

 private:
  struct Heading {
    double yaw_rad = 0;
    double variance_rad2 = kPi * kPi;  ///< Any direction.
    std::int64_t stamp_ns = 0;
  };

  void follow(Vec2 antenna_W, double variance_xy_m2);
  [[nodiscard]] Status check_heading(std::int64_t stamp_ns) const;

  GeoFrame frame_;
  GpsOptions options_;
  Heading heading_;
  bool heard_ = false;          // whether an orientation has arrived
  std::optional<Vec2> anchor_;  // start of the distance for the next heading
};

}  // namespace rave::ros2_driver
