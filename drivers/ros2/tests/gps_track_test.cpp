// SPDX-License-Identifier: Apache-2.0
#include "ros2/gps_track.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rave/ros2/convert.hpp"

namespace rave::ros2_driver {
namespace {

constexpr GeoPoint kOrigin{47.3769, 8.5417, 408};

class Gps : public ::testing::Test {
 protected:
  /// A fix of an antenna at a place in the world, with a standard deviation of half a metre.
  [[nodiscard]] ros2::NavSatFix fix(double x, double y, std::int64_t stamp_ns = 0) const {
    const GeoPoint place = frame_.place({x, y, 2});
    ros2::NavSatFix message{};
    message.header.stamp = ros2::time_of(stamp_ns);
    message.latitude = place.latitude_deg;
    message.longitude = place.longitude_deg;
    message.altitude = place.altitude_m;
    message.position_covariance[0] = 0.25;
    message.position_covariance[4] = 0.16;
    message.position_covariance_type = 2;
    return message;
  }
  [[nodiscard]] static ros2::Imu imu(double yaw_rad, std::int64_t stamp_ns = 0) {
    ros2::Imu message{};
    message.header.stamp = ros2::time_of(stamp_ns);
    message.orientation = ros2::quaternion_of(yaw_rad);
    return message;
  }

  GeoFrame frame_{kOrigin, deg_to_rad(30)};
  GpsOptions options_{{6.25, 0.01}, 0.5, {}, false};
};

TEST_F(Gps, AFixIsAPlaceInTheWorldWhichMayBeTurned) {
  GpsTrack track(frame_, options_);
  const auto reading = track.take(fix(12, -7));
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->x_m, 12, 1e-6);
  EXPECT_NEAR(reading->y_m, -7, 1e-6);
  EXPECT_EQ(reading->variance_xy_m2, 0.25) << "the larger of both axes";
  EXPECT_EQ(reading->variance_yaw_rad2, kPi * kPi) << "it has not moved, so it may look anywhere";
}

TEST_F(Gps, AHeadingFollowsFromTheWay) {
  GpsTrack track(frame_, options_);
  ASSERT_TRUE(track.take(fix(0, 0)));
  auto reading = track.take(fix(0.3, 0.3));
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->yaw_rad, 0) << "too short a way";
  reading = track.take(fix(3, 3));
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->yaw_rad, kPi / 4, 1e-6);
  EXPECT_NEAR(reading->variance_yaw_rad2, 2 * 0.25 / 18, 1e-6);
  reading = track.take(fix(3.1, 3));
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->yaw_rad, kPi / 4, 1e-6) << "it stands, so it looks where it looked";
}

TEST_F(Gps, AnInertialUnitKnowsBetterAndSaysWhereTheBodyIs) {
  options_.has_imu = true;
  options_.antenna_m = {-0.5, 0};
  GpsTrack track(frame_, options_);
  EXPECT_EQ(track.take(fix(1, 1)).error().message, "no orientation has come yet");
  // 120 degrees from east are 90 in this world.
  ASSERT_TRUE(track.hear(imu(deg_to_rad(120), 5'000'000'000)));
  const auto reading = track.take(fix(1, 1, 5'500'000'000));
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->yaw_rad, kPi / 2, 1e-9);
  EXPECT_NEAR(reading->x_m, 1, 1e-6);
  EXPECT_NEAR(reading->y_m, 1.5, 1e-6) << "the antenna is behind the middle";
  EXPECT_EQ(reading->variance_yaw_rad2, 0.01);
  EXPECT_EQ(track.stamp_ns(fix(1, 1, 5'500'000'000)), 5'000'000'000) << "the older of both";
  EXPECT_EQ(track.stamp_ns(fix(1, 1, 4'500'000'000)), 4'500'000'000);
  EXPECT_EQ(track.take(fix(1, 1)).error().message,
            "the fix has no stamp, so the age of the orientation is unknown");
  EXPECT_EQ(track.hear(imu(0)).error().message,
            "the orientation has no stamp, so its age is unknown");
  EXPECT_EQ(track.take(fix(1, 1, 7'500'000'000)).error().message,
            "the newest orientation is 2.5 s from the fix");
  ros2::Imu without = imu(0);
  without.orientation_covariance[0] = -1;
  EXPECT_EQ(track.hear(without).error().message, "it measures no orientation");
}

TEST_F(Gps, WhatIsNoFixOrNotOfThisWorldIsRefused) {
  GpsTrack track(frame_, options_);
  ros2::NavSatFix message = fix(1, 1);
  message.status.status = -1;
  EXPECT_EQ(track.take(message).error().message, "the receiver has no fix");
  message.status.status = 0;
  message.latitude = 0;
  message.longitude = 0;
  EXPECT_EQ(track.take(message).error().message,
            "the fix at latitude 0 and longitude 0 is 4716 km from `geo_origin`");
}

TEST_F(Gps, UnknownCovarianceAndAltitudeAreNoHindrance) {
  GpsTrack track(frame_, options_);
  ros2::NavSatFix message = fix(1, 1);
  message.position_covariance_type = 0;
  message.altitude = std::numeric_limits<double>::quiet_NaN();
  const auto reading = track.take(message);
  ASSERT_TRUE(reading);
  EXPECT_NEAR(reading->x_m, 1, 1e-5);
  EXPECT_EQ(reading->variance_xy_m2, 6.25);
}

TEST(GeoOrigin, TakesTwoToFourNumbers) {
  const auto origin = [](std::vector<double> numbers) { return read_geo_origin(numbers); };
  const auto frame = origin({47, 8, 400, 90});
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->origin(), (GeoPoint{47, 8, 400}));
  EXPECT_NEAR(frame->yaw_rad(), kPi / 2, 1e-12);
  EXPECT_TRUE(origin({-90, 180}));
  EXPECT_EQ(origin({}).error().message.substr(0, 28), "`geo_origin` has 0 numbers; ");
  EXPECT_EQ(origin({8.5, 247}).error().message,
            "`geo_origin` is at latitude 8.5 and longitude 247, not within +-90 and +-180");
}

}  // namespace
}  // namespace rave::ros2_driver
