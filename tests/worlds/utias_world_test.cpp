// SPDX-License-Identifier: Apache-2.0
// The tubes of worlds/utias.yaml are those of the shipped recordings.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "rave/base/file.hpp"
#include "rave/config/yaml.hpp"
#include "utias/dataset.hpp"

namespace rave {
namespace {

const std::filesystem::path kRoot = RAVE_SOURCE_DIR;

/// The mappings under `obstacles:`, by name.
std::map<std::string, codec::RawNode> read_obstacles() {
  const std::filesystem::path path = kRoot / "worlds" / "utias.yaml";
  const auto text = read_file(path, config::kMaxFileBytes);
  EXPECT_TRUE(text);
  if (!text) return {};
  codec::Diagnostics diagnostics;
  const auto world = config::parse_yaml(*text, path.string(), diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << (diagnostics.ok() ? "" : diagnostics.joined().text());
  if (!world || world->find("obstacles") == nullptr) return {};
  std::map<std::string, codec::RawNode> obstacles;
  for (const codec::RawNode& obstacle : world->find("obstacles")->children()) {
    const codec::RawNode* name = obstacle.find("name");
    EXPECT_TRUE(name != nullptr && obstacles.emplace(name->scalar(), obstacle).second);
  }
  return obstacles;
}

double number(const codec::RawNode& obstacle, const std::string& key) {
  const codec::RawNode* node = obstacle.find(key);
  const auto value = node == nullptr ? std::nullopt : node->as_double();
  EXPECT_TRUE(value) << key;
  return value.value_or(-1e9);
}

/// The two ends of a range.
std::pair<double, double> ends(const codec::RawNode& obstacle, const std::string& key) {
  const codec::RawNode* node = obstacle.find(key);
  if (node == nullptr || node->size() != 2) {
    ADD_FAILURE() << key;
    return {};
  }
  return {node->child(0).as_double().value_or(-1e9), node->child(1).as_double().value_or(-1e9)};
}

class UtiasWorld : public testing::TestWithParam<const char*> {};

TEST_P(UtiasWorld, HoldsTheTubesOfTheRecording) {
  const auto data = utias::load(kRoot / "data" / "utias-mrclam6" / GetParam());
  ASSERT_TRUE(data) << data.error().text();
  const auto obstacles = read_obstacles();
  ASSERT_EQ(data->subjects.landmarks().size(), 15U);
  EXPECT_EQ(obstacles.size(), 15U);
  for (const utias::Landmark& landmark : data->subjects.landmarks()) {
    const auto found = obstacles.find("tube-" + std::to_string(landmark.subject));
    ASSERT_NE(found, obstacles.end()) << landmark.subject;
    EXPECT_NEAR(number(found->second, "x_m"), landmark.p_WL.x, 1e-6) << landmark.subject;
    EXPECT_NEAR(number(found->second, "y_m"), landmark.p_WL.y, 1e-6) << landmark.subject;
    EXPECT_EQ(number(found->second, "barcode"), landmark.code) << landmark.subject;
  }
}

INSTANTIATE_TEST_SUITE_P(Stretches, UtiasWorld, testing::Values("100-220", "760-900"));

TEST(UtiasWorldTubes, StandApartAndAreTallerThanTheirBarcodes) {
  const auto obstacles = read_obstacles();
  ASSERT_FALSE(obstacles.empty());
  for (const auto& [name, tube] : obstacles) {
    EXPECT_EQ(tube.find("layer") == nullptr ? "" : tube.find("layer")->scalar(), "mapped_real");
    const auto body = ends(tube, "z_m");
    const auto barcode = ends(tube, "barcode_z_m");
    // What `tools/estimate_tube_radius.py` gives; the test `utias_tube_radius` runs it.
    EXPECT_EQ(number(tube, "disc_radius_m"), 0.04) << name;
    EXPECT_EQ(body.first, 0) << name;
    EXPECT_LT(barcode.first, barcode.second) << name;
    EXPECT_GE(barcode.first, body.first) << name;
    EXPECT_LE(barcode.second, body.second) << name;
    for (const auto& [other_name, other] : obstacles) {
      if (other_name == name) continue;
      const double dx = number(tube, "x_m") - number(other, "x_m");
      const double dy = number(tube, "y_m") - number(other, "y_m");
      const double reach = number(tube, "disc_radius_m") + number(other, "disc_radius_m");
      EXPECT_GT(dx * dx + dy * dy, reach * reach) << name << " and " << other_name;
    }
  }
}

}  // namespace
}  // namespace rave
