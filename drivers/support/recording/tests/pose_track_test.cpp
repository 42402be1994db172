// SPDX-License-Identifier: Apache-2.0
#include "recording/pose_track.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace rave::recording {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr double kPi = std::numbers::pi;

PoseTrack three() {
  return PoseTrack({{100 * kMs, {0, 0, kPi - 0.1}},
                    {200 * kMs, {1, 2, -kPi + 0.1}},
                    {600 * kMs, {2, 2, -kPi + 0.2}}});
}

TEST(PoseTrack, FitsTheVelocityThroughJitter) {
  std::vector<PoseSample> samples;
  for (int i = 0; i < 100; ++i) {
    // Pairs of stamps 2 ms apart, positions wrong by a millimetre in turn: the difference of such
    // a pair is off by a metre per second.
    const std::int64_t t = (i / 2) * 32 * kMs + (i % 2) * 2 * kMs;
    const double t_s = static_cast<double>(t) * 1e-9;
    const double error = i % 2 == 0 ? 0.0005 : -0.0005;
    samples.push_back({t, {0.1 * t_s + error, -0.05 * t_s, wrap_angle(3 + 0.4 * t_s)}});
  }
  const PoseTrack track(std::move(samples));
  const auto velocity = track.velocity(800 * kMs);
  ASSERT_TRUE(velocity);
  EXPECT_NEAR(velocity->v_WR_W.x, 0.1, 0.005);
  EXPECT_NEAR(velocity->v_WR_W.y, -0.05, 1e-9);
  EXPECT_NEAR(velocity->wz, 0.4, 1e-9) << "across the seam of the heading at 354 ms and elsewhere";
  EXPECT_NEAR(track.velocity(354 * kMs)->wz, 0.4, 1e-9);
}

TEST(PoseTrack, HasNoVelocityWithoutSamples) {
  const PoseTrack track = three();
  EXPECT_FALSE(track.velocity(150 * kMs));
  EXPECT_TRUE(track.velocity(300 * kMs, 500 * kMs));
  EXPECT_FALSE(track.velocity(601 * kMs, 900 * kMs)) << "after the last sample";
  EXPECT_FALSE(PoseTrack().velocity(0));
}

TEST(PoseTrack, WrapsAngles) {
  EXPECT_EQ(wrap_angle(kPi), kPi);
  EXPECT_EQ(wrap_angle(-kPi), kPi);
  EXPECT_NEAR(wrap_angle(3 * kPi / 2), -kPi / 2, 1e-15);
  EXPECT_EQ(wrap_angle(0.25), 0.25);
}

}  // namespace
}  // namespace rave::recording
