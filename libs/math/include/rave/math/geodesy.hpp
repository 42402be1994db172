// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/math/scalar.hpp"

/// Conversion between the plane of a world and positions on the earth in WGS 84 (NIMA TR8350.2),
/// the datum of satellite navigation. Pure; any thread.
namespace rave {

/// A position on the earth. Latitude in [-90, 90], positive north; longitude in [-180, 180],
/// positive east; altitude above the ellipsoid, not above sea level.
struct GeoPoint {
  double latitude_deg = 0;
  double longitude_deg = 0;
  double altitude_m = 0;

  friend constexpr bool operator==(const GeoPoint&, const GeoPoint&) noexcept = default;
};

/// A point in space, metres. The function that uses it states the frame.
struct Point3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend constexpr bool operator==(const Point3&, const Point3&) noexcept = default;
};

/// A position in the earth-centred, earth-fixed frame: z to the north pole, x to the meridian of
/// Greenwich.
[[nodiscard]] Point3 earth_point(const GeoPoint& place) noexcept;
/// The inverse of earth_point(), within 1e-8 m from 10 km below the ellipsoid to 100 km above.
/// Source: Bowring, "The accuracy of geodetic latitude and height equations", Survey Review 28,
/// 1985.
[[nodiscard]] GeoPoint geo_point(const Point3& earth) noexcept;

/// The frame of a world whose plane touches the earth at its origin: z up, x turned by `yaw` from
/// east towards north. With a yaw of 0, x is east and y is north.
class GeoFrame {
 public:
  explicit GeoFrame(const GeoPoint& origin, double yaw_rad = 0) noexcept;

  /// A position in the world's frame. The plane is tangent to the earth: 1 km from the origin the
  /// ground is 8 cm below it, at 10 km 8 m.
  [[nodiscard]] Point3 world_point(const GeoPoint& place) const noexcept;
  [[nodiscard]] GeoPoint place(const Point3& world) const noexcept;
  [[nodiscard]] const GeoPoint& origin() const noexcept { return origin_; }
  /// Direction of the world's x axis, from east towards north.
  [[nodiscard]] double yaw_rad() const noexcept { return yaw_rad_; }

 private:
  GeoPoint origin_;
  double yaw_rad_;
  Point3 centre_;  // the world's origin in the earth-centred frame
  SinCos latitude_;
  SinCos longitude_;
  SinCos yaw_;
};

}  // namespace rave
