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

/// The frame of the world on the earth: latitude and longitude in degrees, and if given altitude in
/// metres and the yaw of the world's x axis from east, in degrees. Error kInvalidArgument.
[[nodiscard]] Result<GeoFrame> read_geo_origin(std::span<const double> numbers);

struct GpsOptions {
  Doubt doubt;                   ///< Where messages do not have theirs.
  double course_distance_m = 0;  ///< Way between two fixes from which a heading follows.
  Vec2 antenna_m;                ///< In the frame of the body.
  bool has_imu = false;          ///< The heading comes from there.
};

/// The pose of a robot in the world out of the fixes of its receiver. A receiver has no heading: it
/// is that of an inertial unit, or else of the way that the antenna went. A value; messages have
/// passed ros2::validate(). One thread at a time.
class GpsTrack {
 public:
  GpsTrack(const GeoFrame& frame, const GpsOptions& options) : frame_(frame), options_(options) {}

  /// Error kInvalidArgument: it measures no orientation.
  Status hear(const ros2::Imu& message);
  /// Errors: kState (no fix; no heading yet, or one that is older by more than a second),
  /// kInvalidArgument (too far from the origin to be in this world).
  [[nodiscard]] Result<PoseReading> take(const ros2::NavSatFix& message);

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
  bool heard_ = false;          // something of the inertial unit
  std::optional<Vec2> anchor_;  // where the way of the next heading begins
};

}  // namespace rave::ros2_driver
