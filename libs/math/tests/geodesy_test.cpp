// SPDX-License-Identifier: Apache-2.0
#include "rave/math/geodesy.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rave {
namespace {

double degrees(double whole, double minutes, double seconds) {
  return whole + minutes / 60 + seconds / 3600;
}

/// The example of IOGP publication 373-7-2 ("EPSG Guidance Note 7-2"), methods 9602 and 9837.
const GeoPoint kExample{degrees(53, 48, 33.820), degrees(2, 7, 46.380), 73.0};

TEST(Geodesy, TheGeocentricExampleOfEpsg) {
  const Point3 earth = earth_point(kExample);
  EXPECT_NEAR(earth.x, 3771793.968, 5e-4);
  EXPECT_NEAR(earth.y, 140253.342, 5e-4);
  EXPECT_NEAR(earth.z, 5124304.349, 5e-4);
  const GeoPoint back = geo_point(earth);
  EXPECT_NEAR(back.latitude_deg, kExample.latitude_deg, 1e-13);
  EXPECT_NEAR(back.longitude_deg, kExample.longitude_deg, 1e-13);
  EXPECT_NEAR(back.altitude_m, 73, 1e-8);
}

TEST(Geodesy, TheTopocentricExampleOfEpsg) {
  const GeoFrame frame({55, 5, 200});
  const Point3 point = frame.world_point(kExample);
  EXPECT_NEAR(point.x, -189013.869, 5e-4);
  EXPECT_NEAR(point.y, -128642.040, 5e-4);
  EXPECT_NEAR(point.z, -4220.171, 5e-4);
  const GeoPoint back = frame.place(point);
  EXPECT_NEAR(back.latitude_deg, kExample.latitude_deg, 1e-12);
  EXPECT_NEAR(back.longitude_deg, kExample.longitude_deg, 1e-12);
  EXPECT_NEAR(back.altitude_m, 73, 1e-6);
}

TEST(Geodesy, TheAxesOfTheEllipsoid) {
  // Of TR8350.2: the semi-axes, at sea level on the equator and at the poles.
  EXPECT_NEAR(earth_point({0, 90, 0}).y, 6378137.0, 1e-8);
  EXPECT_NEAR(earth_point({90, 0, 0}).z, 6356752.3142, 1e-4);
  EXPECT_NEAR(geo_point({0, 0, -6356752.314245}).latitude_deg, -90, 1e-12);
  EXPECT_NEAR(geo_point({0, 0, -6356752.314245}).altitude_m, 0, 1e-5);
}

TEST(Geodesy, ThereAndBackEverywhere) {
  for (int latitude = -90; latitude <= 90; latitude += 5) {
    for (const double longitude : {-179.5, -90.0, 0.0, 33.25, 180.0}) {
      for (const double altitude : {-10'000.0, 0.0, 450.0, 100'000.0}) {
        const GeoPoint place{static_cast<double>(latitude), longitude, altitude};
        const GeoPoint back = geo_point(earth_point(place));
        // 1e-13 degrees are 1e-8 m.
        EXPECT_NEAR(back.latitude_deg, place.latitude_deg, 1e-13);
        EXPECT_NEAR(back.altitude_m, altitude, 1e-8);
        if (std::abs(latitude) == 90) continue;  // all longitudes meet there
        EXPECT_NEAR(back.longitude_deg, longitude, 1e-12);
      }
    }
  }
}

TEST(Geodesy, AWorldMayBeTurned) {
  const GeoPoint origin{47.3769, 8.5417, 408};
  const GeoFrame straight(origin);
  const GeoFrame turned(origin, kPi / 6);
  const Point3 east = straight.world_point(turned.place({10, 0, 0}));
  EXPECT_NEAR(east.x, 10 * std::cos(kPi / 6), 1e-8);
  EXPECT_NEAR(east.y, 10 * std::sin(kPi / 6), 1e-8);
  const Point3 back = turned.world_point(turned.place({-25, 40, 1.5}));
  EXPECT_NEAR(back.x, -25, 1e-8);
  EXPECT_NEAR(back.y, 40, 1e-8);
  EXPECT_NEAR(back.z, 1.5, 1e-8);
  // A metre north is 1/111.2 thousandth of a degree here.
  EXPECT_NEAR(straight.place({0, 1, 0}).latitude_deg - origin.latitude_deg, 1 / 111'180.0, 1e-8);
}

}  // namespace
}  // namespace rave
