// SPDX-License-Identifier: Apache-2.0
#include "rave/math/geodesy.hpp"

#include <cmath>

namespace rave {
namespace {

constexpr double kEquator_m = 6378137.0;
constexpr double kFlattening = 1 / 298.257223563;
constexpr double kPole_m = kEquator_m * (1 - kFlattening);
constexpr double kEccentricity2 = kFlattening * (2 - kFlattening);
constexpr double kSecondEccentricity2 = kEccentricity2 / (1 - kEccentricity2);

/// The radius of curvature in the prime vertical: the length of the normal from the ellipsoid to
/// the polar axis.
double normal_m(double sin_latitude) noexcept {
  return kEquator_m / std::sqrt(1 - kEccentricity2 * sin_latitude * sin_latitude);
}

}  // namespace

Point3 earth_point(const GeoPoint& place) noexcept {
  const SinCos latitude = sincos(deg_to_rad(place.latitude_deg));
  const SinCos longitude = sincos(deg_to_rad(place.longitude_deg));
  const double normal = normal_m(latitude.sin);
  const double from_axis_m = (normal + place.altitude_m) * latitude.cos;
  return {from_axis_m * longitude.cos, from_axis_m * longitude.sin,
          (normal * (1 - kEccentricity2) + place.altitude_m) * latitude.sin};
}

GeoPoint geo_point(const Point3& earth) noexcept {
  const double from_axis_m = std::sqrt(earth.x * earth.x + earth.y * earth.y);
  // Iteration over the reduced latitude; two rounds are precise to the rounding of a double.
  double reduced_rad = atan2(earth.z * kEquator_m, from_axis_m * kPole_m);
  double latitude_rad = 0;
  for (int round = 0; round < 2; ++round) {
    const SinCos u = sincos(reduced_rad);
    latitude_rad = atan2(earth.z + kSecondEccentricity2 * kPole_m * u.sin * u.sin * u.sin,
                         from_axis_m - kEccentricity2 * kEquator_m * u.cos * u.cos * u.cos);
    const SinCos latitude = sincos(latitude_rad);
    reduced_rad = atan2((1 - kFlattening) * latitude.sin, latitude.cos);
  }
  const SinCos latitude = sincos(latitude_rad);
  const double height_m = from_axis_m * latitude.cos + earth.z * latitude.sin -
                          kEquator_m * kEquator_m / normal_m(latitude.sin);
  return {rad_to_deg(latitude_rad), rad_to_deg(atan2(earth.y, earth.x)), height_m};
}

GeoFrame::GeoFrame(const GeoPoint& origin, double yaw_rad) noexcept
    : origin_(origin),
      yaw_rad_(yaw_rad),
      centre_(earth_point(origin)),
      latitude_(sincos(deg_to_rad(origin.latitude_deg))),
      longitude_(sincos(deg_to_rad(origin.longitude_deg))),
      yaw_(sincos(yaw_rad)) {}

Point3 GeoFrame::world_point(const GeoPoint& place) const noexcept {
  const Point3 earth = earth_point(place);
  const Point3 d{earth.x - centre_.x, earth.y - centre_.y, earth.z - centre_.z};
  const double outward = longitude_.cos * d.x + longitude_.sin * d.y;
  const double east = longitude_.cos * d.y - longitude_.sin * d.x;
  const double north = latitude_.cos * d.z - latitude_.sin * outward;
  const double up = latitude_.cos * outward + latitude_.sin * d.z;
  return {yaw_.cos * east + yaw_.sin * north, yaw_.cos * north - yaw_.sin * east, up};
}

GeoPoint GeoFrame::place(const Point3& world) const noexcept {
  const double east = yaw_.cos * world.x - yaw_.sin * world.y;
  const double north = yaw_.sin * world.x + yaw_.cos * world.y;
  const double outward = latitude_.cos * world.z - latitude_.sin * north;
  return geo_point({centre_.x + longitude_.cos * outward - longitude_.sin * east,
                    centre_.y + longitude_.sin * outward + longitude_.cos * east,
                    centre_.z + latitude_.cos * north + latitude_.sin * world.z});
}

}  // namespace rave
