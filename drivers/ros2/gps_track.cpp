// SPDX-License-Identifier: Apache-2.0
#include "ros2/gps_track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "rave/math/transform.hpp"
#include "rave/ros2/convert.hpp"

namespace rave::ros2_driver {
namespace {

/// Beyond this distance the plane of the world is far from the ground.
/// The plane touches the ellipsoid at the origin. At distance d it is d^2 / 2R above the ground: 20
/// cm at 1.6 km, 785 m at 100 km.
constexpr double kFarthest_m = 100'000;
// A robot that turns with 1 rad/s has another heading after a second; the offset of the antenna
// would then point elsewhere.
constexpr std::int64_t kOldestHeading_ns = 1'000'000'000;
constexpr std::uint8_t kUnknownCovariance = 0;
/// Indices of east and north in a 3x3 covariance, and of the yaw in that of an orientation.
constexpr std::size_t kEast = 0;
constexpr std::size_t kNorth = 4;
constexpr std::size_t kYaw = 8;

double variance_of(const ros2::NavSatFix& message, double otherwise) {
  if (message.position_covariance_type == kUnknownCovariance) return otherwise;
  const double xy =
      // The larger of both axes, so that the one number does not promise too much.
      std::max(message.position_covariance[kEast], message.position_covariance[kNorth]);
  return xy > 0 ? xy : otherwise;
}

}  // namespace

Result<GeoFrame> read_geo_origin(std::span<const double> numbers) {
  std::array<double, 4> all{};
  if (numbers.size() < 2 || numbers.size() > all.size()) {
    return fail(ErrorCode::kInvalidArgument,
                "`geo_origin` has {} numbers; expected that of the scenario, or latitude and "
                "longitude in degrees, and optionally altitude in metres and the yaw of the "
                "world's x axis from east in degrees",
                numbers.size());
  }
  std::ranges::copy(numbers, all.begin());
  const auto [latitude_deg, longitude_deg, altitude_m, yaw_deg] = all;
  if (std::abs(latitude_deg) > 90 || std::abs(longitude_deg) > 180) {
    return fail(ErrorCode::kInvalidArgument,
                "`geo_origin` is at latitude {} and longitude {}, not within +-90 and +-180",
                latitude_deg, longitude_deg);
  }
  return GeoFrame({latitude_deg, longitude_deg, altitude_m}, deg_to_rad(yaw_deg));
}

Status GpsTrack::hear(const ros2::Imu& message) {
  if (message.orientation_covariance[0] == -1) {
    return fail(ErrorCode::kInvalidArgument, "it measures no orientation");
  }
  const std::int64_t stamp_ns = ros2::nanoseconds(message.header.stamp);
  if (stamp_ns == 0) {
    return fail(ErrorCode::kInvalidArgument, "the orientation has no stamp, so its age is unknown");
  }
  const double variance = message.orientation_covariance[kYaw];
  // ENU orientations count from east (REP-103); the x axis of the world may point elsewhere.
  heading_ = {wrap_angle(ros2::attitude_of(message.orientation).yaw_rad - frame_.yaw_rad()),
              variance > 0 ? variance : options_.doubt.variance_yaw_rad2, stamp_ns};
  heard_ = true;
  return {};
}

Status GpsTrack::check_heading(std::int64_t stamp_ns) const {
  if (!options_.has_imu) return {};
  if (!heard_) return fail(ErrorCode::kState, "no orientation has come yet");
  if (stamp_ns == 0) {
    return fail(ErrorCode::kInvalidArgument,
                "the fix has no stamp, so the age of the orientation is unknown");
  }
  const std::int64_t age_ns = std::abs(stamp_ns - heading_.stamp_ns);
  if (age_ns <= kOldestHeading_ns) return {};
  return fail(ErrorCode::kState, "the newest orientation is {:.1f} s from the fix",
              static_cast<double>(age_ns) * 1e-9);
}

std::int64_t GpsTrack::stamp_ns(const ros2::NavSatFix& message) const noexcept {
  const std::int64_t fix_ns = ros2::nanoseconds(message.header.stamp);
  return options_.has_imu ? std::min(fix_ns, heading_.stamp_ns) : fix_ns;
}

void GpsTrack::follow(Vec2 antenna_W, double variance_xy_m2) {
  if (!anchor_) anchor_ = antenna_W;
  const Vec2 way = antenna_W - *anchor_;
  const double way_m2 = squared_norm(way);
  if (way_m2 < options_.course_distance_m * options_.course_distance_m || way_m2 == 0) return;
  // Without an orientation sensor the course over ground is the heading, which is right for a robot
  // that drives forward. Two ends with variance v each, at distance d, give the direction a
  // variance of about 2 v / d^2.
  heading_ = {atan2(way.y, way.x), std::min(2 * variance_xy_m2 / way_m2, kPi * kPi), 0};
  anchor_ = antenna_W;
}

Result<PoseReading> GpsTrack::take(const ros2::NavSatFix& message) {
  if (message.status.status < 0) return fail(ErrorCode::kState, "the receiver has no fix");
  RAVE_TRY(check_heading(ros2::nanoseconds(message.header.stamp)));
  const double altitude_m =
      std::isnan(message.altitude) ? frame_.origin().altitude_m : message.altitude;
  const Point3 world = frame_.world_point({message.latitude, message.longitude, altitude_m});
  const Vec2 antenna_W{world.x, world.y};
  if (!(squared_norm(antenna_W) <= kFarthest_m * kFarthest_m)) {
    return fail(ErrorCode::kInvalidArgument,
                "the fix at latitude {} and longitude {} is {:.0f} km from `geo_origin`",
                message.latitude, message.longitude, std::sqrt(squared_norm(antenna_W)) / 1000);
  }
  const double variance = variance_of(message, options_.doubt.variance_xy_m2);
  if (!options_.has_imu) follow(antenna_W, variance);
  // The receiver gives the place of the antenna, which is not at the origin of the body.
  const Vec2 body_W = antenna_W - rotate(heading_.yaw_rad, options_.antenna_m);
  return PoseReading{body_W.x, body_W.y, heading_.yaw_rad, variance, heading_.variance_rad2};
}

}  // namespace rave::ros2_driver
