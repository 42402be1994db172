// SPDX-License-Identifier: Apache-2.0
#include "page/frames.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include "rave/base/file.hpp"
#include "rave/onlook/reading_rows.hpp"
#include "run/reading_json.hpp"

namespace rave::gui_server {
namespace {

using Json = nlohmann::ordered_json;

std::string hex_of(const std::string& bytes) {
  std::string hex;
  for (const char byte : bytes) hex += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return hex;
}

std::vector<PosesAt> sample_poses() {
  PosesAt plain{0, 17.5, 1750, {}};
  plain.robots = {{3.64, -1.45, 1.763, 0.062, kKnown | kReal},
                  {-0.00004, 1e-4, -3.1, -0.2, kKnown | kStale},
                  {0, 0, 0, 0, kReal}};
  PosesAt far{0, 0.01, 1, {}};
  far.robots = {{500000.25, -7000000.5, 0, 1e9, kKnown},
                {500001.25, -7000001.5, 6.2831, 0, kKnown | kStopped | kTouching}};
  return {plain, far, PosesAt{0, 1, 100, {}}};
}

std::vector<ReadingAt> sample_readings() {
  const float none = std::numeric_limits<float>::infinity();
  return {{2, 0, 0, 17.49, 4, 1, {1.25F, none, 0.5F, 3.999F}},
          {70000, 3, 2, 0.1, 2, 3, {14, 2.5F, -0.3F, 15, 2.75F, 0.25F}},
          {0, 1, 1, 5, 0, 5, {}}};
}

Json poses_json(const PosesAt& poses, const PoseFrameHead& head) {
  Json json = {{"hex", hex_of(encode_poses(poses, head))},
               {"sequence", head.sequence},
               {"time_s", poses.time_s},
               {"step", poses.step},
               {"past", head.past},
               {"x", Json::array()},
               {"y", Json::array()},
               {"yaw", Json::array()},
               {"speed", Json::array()},
               {"flags", Json::array()}};
  for (const RobotState& robot : poses.robots) {
    json["x"].push_back(robot.x_m);
    json["y"].push_back(robot.y_m);
    json["yaw"].push_back(robot.yaw_rad);
    json["speed"].push_back(std::min(robot.speed_mps, 32.767));
    json["flags"].push_back(robot.flags);
  }
  return json;
}

Json reading_json(const ReadingAt& reading, bool past) {
  Json json = {{"hex", hex_of(encode_reading(reading, 17.5, past))},
               {"slot", reading.slot},
               {"sensor", reading.sensor},
               {"part", reading.part},
               {"past", past},
               {"stamp_s", reading.stamp_s},
               {"rows", reading.rows},
               {"fields", reading.fields},
               {"values", Json::array()}};
  for (const float value : reading.values) {
    json["values"].push_back(std::isfinite(value) ? Json(value) : Json(nullptr));
  }
  return json;
}

/// The upper right tile of a map of 66 x 65 cells.
Json tile_json(const MapName& name) {
  MapShown map{{0.05, {-1.25, 500000.5}, 66, 65}, SimTime{2'500'000'000}, {}};
  map.tiles[{1, 1}] = {9, SimTime{2'500'000'000}, {100, maps::kUnknown}};
  Json json = {{"hex", hex_of(encode_tile(name, map, 1, 1))},
               {"name", name.global() ? name.name : ""},
               {"slot", name.slot},
               {"stamp_s", 2.5},
               {"origin", Json::array({-1.25, 500000.5})},
               {"resolution_m", 0.05},
               {"size", Json::array({66, 65})},
               {"column", 1},
               {"row", 1},
               {"width", 2},
               {"height", 1},
               {"cells", Json::array({100, 255})}};
  return json;
}

/// The page's tests read the same file. RAVE_WRITE_FRAMES=1 writes it anew after a change.
TEST(Frames, AreThoseThatThePageIsTestedWith) {
  Json json = {{"poses", Json::array()}, {"readings", Json::array()}};
  std::uint32_t sequence = 0;
  for (const PosesAt& poses : sample_poses()) {
    ++sequence;
    json["poses"].push_back(poses_json(poses, {sequence, sequence == 2, false}));
  }
  for (const ReadingAt& reading : sample_readings()) {
    json["readings"].push_back(reading_json(reading, reading.part == 2));
  }
  const std::vector<VarianceAt> variances = {{0, 0.25F, 0.0625F}, {70000, 4, 0}};
  json["variances"] = {
      {{"hex", hex_of(encode_variances(variances, 17.5))},
       {"time_s", 17.5},
       {"robots", Json::array({Json::array({0, 0.25, 0.0625}), Json::array({70000, 4, 0})})}},
      {{"hex", hex_of(encode_variances({}, 0))}, {"time_s", 0}, {"robots", Json::array()}}};
  json["tiles"] = {tile_json({3, "walker"}), tile_json({maps::kNoRobot, "höhle"})};
  const std::string text = json.dump(1) + "\n";
  if (std::getenv("RAVE_WRITE_FRAMES") != nullptr) {
    ASSERT_TRUE(write_file_atomically(RAVE_FRAMES, text));
  }
  const auto kept = read_file(RAVE_FRAMES);
  ASSERT_TRUE(kept) << kept.error().text();
  EXPECT_EQ(*kept, text);
}

/// The page names the numbers of a row by `fields` of the sensor.
TEST(Frames, ARowHasANumberForEachFieldThatThePageIsTold) {
  const OdometryReading odometry{1, 2, 3, 4, 5, 6, 7};
  std::vector<float> values;
  EXPECT_EQ(
      onlook::add_rows(ReadingKind::kOdometry, 1, std::as_bytes(std::span(&odometry, 1)), values),
      1U);
  EXPECT_EQ(values, (std::vector<float>{1, 2, 3, 4, 5, 6, 7}));
  Json sensor;
  add_reading_type(sensor, ReadingKind::kOdometry);
  ASSERT_EQ(sensor.at("fields").size(), values.size());
  EXPECT_EQ(
      sensor.at("fields")[6].dump(),
      R"({"name":"variance_yaw_rad2","label":"variance yaw","unit":"rad²","format":"float64"})");
  EXPECT_EQ(sensor.at("fields")[2].at("variance"), "variance_yaw_rad2");
  EXPECT_FALSE(sensor.contains("list"));
  add_reading_type(sensor, ReadingKind::kSightings);
  EXPECT_EQ(sensor.at("list"), true);
}

/// As in a recording of a later version.
TEST(Frames, AReadingOfAnUnknownKindHasNoFields) {
  EXPECT_EQ(onlook::field_count(static_cast<ReadingKind>(200)), 0U);
}

TEST(Frames, TakeFourteenBytesARobot) {
  const PosesAt poses = sample_poses().front();
  EXPECT_EQ(encode_poses(poses, {}).size(), 48 + 14 * poses.robots.size());
}

}  // namespace
}  // namespace rave::gui_server
