// SPDX-License-Identifier: Apache-2.0
// The shipped map is the one that the shipped log gives, and it is what a map should be.
#include <gtest/gtest.h>

#include <filesystem>

#include "carmen_map/build_map.hpp"
#include "rave/base/file.hpp"
#include "rave/config/map_image.hpp"

namespace rave {
namespace {

const std::filesystem::path kRoot = RAVE_SOURCE_DIR;

tools::MapOptions options() {
  tools::MapOptions options;
  options.log = kRoot / "data/freiburg-079/104-224/freiburg-079.log.gz";
  options.fov_deg = 179.5;
  options.yaw_deg = -0.25;
  options.resolution_m = 0.04;
  return options;
}

TEST(FreiburgMap, IsMadeFromTheShippedLogToTheByte) {
  const auto made = tools::build_map(options(), "freiburg-079-map.pgm");
  ASSERT_TRUE(made) << made.error().text();
  EXPECT_EQ(made->image == *read_file(kRoot / "worlds/freiburg-079-map.pgm"), true);
  EXPECT_EQ(made->yaml, *read_file(kRoot / "worlds/freiburg-079-map.yaml"));
}

TEST(FreiburgMap, TheRobotDroveThroughFreeCells) {
  const auto map = config::read_map(kRoot / "worlds/freiburg-079-map.yaml");
  ASSERT_TRUE(map) << map.error().text();
  const auto log = carmen::load(options().log);
  ASSERT_TRUE(log);
  int scans = 0;
  for (const carmen::Scan& scan : log->scans) {
    const int column = static_cast<int>((scan.X_WL.x - map->origin_x_m) / map->resolution_m);
    const int row = static_cast<int>((scan.X_WL.y - map->origin_y_m) / map->resolution_m);
    EXPECT_EQ(map->at(column, map->height - 1 - row), config::CellState::kFree)
        << scan.X_WL.x << ", " << scan.X_WL.y;
    ++scans;
  }
  EXPECT_GT(scans, 550);
}

}  // namespace
}  // namespace rave
