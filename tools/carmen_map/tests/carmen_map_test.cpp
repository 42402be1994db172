// SPDX-License-Identifier: Apache-2.0
// Maps of other people's logs; the logs are those of the driver's tests.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "carmen_map/build_map.hpp"

namespace rave::tools {
namespace {

MapOptions of_log(const std::string& name) {
  MapOptions options;
  options.log = std::filesystem::path(RAVE_SOURCE_DIR) / "drivers/carmen/tests/logs" / name;
  return options;
}

MapFiles map_of(const MapOptions& options) {
  auto made = build_map(options, "a.pgm");
  EXPECT_TRUE(made) << made.error().text();
  return made.value_or(MapFiles{});
}

/// The exit code of the program for a log.
int exit_code(const std::filesystem::path& log) {
  const std::string output = testing::TempDir() + "/carmen_map_test/map";
  const std::string command = std::string(RAVE_BINARY_DIR "/bin/rave-carmen-map '") + log.string() +
                              "' 0 0 '" + output + "' > /dev/null 2>&1";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The area of free cells in square metres.
double free_m2(const MapFiles& files) {
  constexpr std::size_t kMostHeader = 64;
  const std::string_view cells = std::string_view(files.image).substr(kMostHeader);
  const auto free = std::ranges::count(cells, static_cast<char>(254));
  return static_cast<double>(free) * 0.05 * 0.05;
}

/// The room has 24 square metres.
TEST(CarmenMap, NoReturnIsNotFreeSpace) {
  MapOptions options = of_log("one_stamp.log");
  options.fov_deg = 171.887;
  const MapFiles found = map_of(options);
  EXPECT_GT(free_m2(found), 8);
  EXPECT_LT(free_m2(found), 24);
  EXPECT_EQ(found.poor, "");
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_NE(found.notes[0].find("exactly 51.15 m"), std::string::npos) << found.notes[0];
  options.no_return_m = 0;
  EXPECT_GT(free_m2(map_of(options)), free_m2(found) + 0.5) << "rays through the walls";
}

TEST(CarmenMap, IsMadeOfNewerAndOfRawRowsWithTheirOwnDirections) {
  const MapFiles newer = map_of(of_log("robotlaser.log"));
  EXPECT_EQ(newer.summary.find("29 scans, "), 0U) << newer.summary;
  EXPECT_LT(free_m2(newer), 24);
  EXPECT_GT(free_m2(newer), 8);
  EXPECT_EQ(newer.poor, "");
  const MapFiles raw = map_of(of_log("rawlaser.log"));
  EXPECT_NEAR(free_m2(raw), free_m2(newer), 1);
}

TEST(CarmenMap, OfNearlyNothingSaysWhy) {
  const auto one = build_map(of_log("damaged.log"), "a.pgm");
  ASSERT_FALSE(one);
  EXPECT_NE(one.error().text().find("only one usable scan of the front laser"), std::string::npos);
  EXPECT_NE(one.error().text().find("29 rows are refused, the first: "), std::string::npos);
  // The whole rows, and behind them as many that lost a word.
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "carmen_map_test";
  std::filesystem::create_directories(folder);
  std::ifstream whole(of_log("rawlaser.log").log);
  std::ofstream log(folder / "a.log");
  for (std::string line; std::getline(whole, line);) {
    log << line << '\n';
    if (line.starts_with("RAW")) log << line.substr(0, line.rfind(' ')) << "\nRAWLASER1 0\n";
  }
  log.close();
  MapOptions options = of_log("");
  options.log = folder / "a.log";
  const MapFiles files = map_of(options);
  EXPECT_EQ(exit_code(options.log), 1);
  EXPECT_EQ(exit_code(of_log("rawlaser.log").log), 0);
  EXPECT_EQ(files.poor.find("a map of 30 of the 90 scans of the log\n  refused: "), 0U)
      << files.poor;
}

TEST(CarmenMap, OfTheRearLaserIsRefusedWhereThereIsNone) {
  MapOptions options = of_log("robotlaser.log");
  options.side = carmen::LaserSide::kRear;
  const auto none = build_map(options, "a.pgm");
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().text().find("the log has no scan of the rear laser (RLASER, ROBOTLASER2, "
                                     "RAWLASER2); it has "),
            std::string::npos)
      << none.error().text();
}

}  // namespace
}  // namespace rave::tools
