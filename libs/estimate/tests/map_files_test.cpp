// SPDX-License-Identifier: Apache-2.0
// What is written is what the reader of maps reads.
#include "rave/estimate/map_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "rave/base/file.hpp"
#include "rave/config/map_image.hpp"

namespace rave::estimate {
namespace {

TEST(MapFiles, AreReadBackCellByCell) {
  auto grid = OccupancyGrid::create({0.25, {-1.5, 3.25}, 12, 8}, {});
  ASSERT_TRUE(grid);
  const double bearings_rad[] = {0.0, 0.4};
  const float ranges_m[] = {1.6F, 1.2F};
  for (int i = 0; i < 6; ++i) grid->add({{-1.1, 3.6, 0}, bearings_rad, ranges_m});

  const auto folder =
      std::filesystem::temp_directory_path() / ("rave_map_files_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  ASSERT_TRUE(write_file_atomically(folder / "a.pgm", map_image(*grid, {})));
  ASSERT_TRUE(
      write_file_atomically(folder / "a.yaml", map_yaml(grid->frame(), {}, "a.pgm", "# why\n")));
  const auto map = config::read_map(folder / "a.yaml");
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(map) << map.error().text();
  EXPECT_EQ(map->width, 12);
  EXPECT_EQ(map->height, 8);
  EXPECT_EQ(map->resolution_m, 0.25);
  EXPECT_EQ(map->origin_x_m, -1.5);
  EXPECT_EQ(map->origin_y_m, 3.25);
  int occupied = 0;
  int free = 0;
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 12; ++column) {
      const config::CellState state = map->at(column, 7 - row);
      const double log_odds = grid->log_odds(column, row);
      occupied += log_odds > 1 ? 1 : 0;
      free += log_odds < -1 ? 1 : 0;
      const auto expected = log_odds > 1    ? config::CellState::kOccupied
                            : log_odds < -1 ? config::CellState::kFree
                                            : config::CellState::kUnknown;
      EXPECT_EQ(state, expected) << column << ", " << row << ": " << log_odds;
    }
  }
  EXPECT_EQ(occupied, 2);
  EXPECT_GT(free, 5);
}

}  // namespace
}  // namespace rave::estimate
