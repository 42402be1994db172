// SPDX-License-Identifier: Apache-2.0
#include "rave/maps/map_save.hpp"

#include <gtest/gtest.h>

#include "rave/base/file.hpp"
#include "rave/maps/map_tile.hpp"

namespace rave::maps {
namespace {

TEST(MapSave, IsReadByMapServer) {
  const std::filesystem::path base = testing::TempDir() + "map_save_test";
  MapTile tile{"global", kNoRobot, {0.05, {-3.2, 6.4}, 128, 64}, 1, 0, 1, {}, {}};
  tile.cells.assign(std::size_t{kTileCells} * kTileCells, kUnknown);
  tile.cells[0] = 100;  // the lowest row, its first column
  tile.cells[1] = 0;
  tile.cells[2] = 50;
  tile.cells[63 * 64 + 63] = 66;  // the upper right corner
  ASSERT_TRUE(save({tile}, base));
  const std::string image = read_file(base.string() + ".pgm").value_or("");
  const std::string head = "P5\n128 64\n255\n";
  ASSERT_EQ(image.size(), head.size() + 128 * 64);
  EXPECT_EQ(image.substr(0, head.size()), head);
  const auto pixel = [&](std::size_t line, std::size_t column) {
    return static_cast<unsigned char>(image[head.size() + line * 128 + column]);
  };
  EXPECT_EQ(pixel(63, 64), 0) << "the last line of an image is the lowest row";
  EXPECT_EQ(pixel(63, 65), 254);
  EXPECT_EQ(pixel(63, 66), 205);
  EXPECT_EQ(pixel(0, 127), 0);
  EXPECT_EQ(pixel(0, 0), 205);
  const std::string yaml = read_file(base.string() + ".yaml").value_or("");
  for (const char* line :
       {"image: map_save_test.pgm\n", "resolution: 0.05\n", "origin: [-3.2, 6.4, 0]\n",
        "negate: 0\n", "occupied_thresh: 0.65\n", "free_thresh: 0.196\n"}) {
    EXPECT_NE(yaml.find(line), std::string::npos) << line;
  }
  EXPECT_FALSE(save({}, base));
}

}  // namespace
}  // namespace rave::maps
