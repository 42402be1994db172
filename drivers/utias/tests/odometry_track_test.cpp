// SPDX-License-Identifier: Apache-2.0
#include "utias/odometry_track.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rave::utias {
namespace {

TEST(OdometryTrack, HoldsTheLastCommand) {
  const std::vector<OdometrySample> log = {{10, 1, 0}, {20, 2, 0}};
  EXPECT_FALSE(command_at(log, 9));
  EXPECT_EQ(command_at(log, 10)->v_mps, 1);
  EXPECT_EQ(command_at(log, 19)->v_mps, 1);
  EXPECT_EQ(command_at(log, 1'000'000)->v_mps, 2);
}

}  // namespace
}  // namespace rave::utias
