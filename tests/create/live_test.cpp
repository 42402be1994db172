// SPDX-License-Identifier: Apache-2.0
// A real robot on one host and a simulated one that sees it on another.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "rave/run_testing/create_run.hpp"
#include "rave/run_testing/recorded_run.hpp"

namespace rave::tests {
namespace {

using Json = nlohmann::json;

constexpr double kGhostX_m = 3.7;
constexpr double kGhostY_m = 0.3;
/// Stands in a corner and looks at nothing but real robots.
constexpr const char* kGhost =
    "  - name: ghost\n"
    "    pose: {x_m: 3.7, y_m: 0.3, yaw_deg: 135}\n"
    "    robot:\n"
    "      body: {shapes: [{disc_radius_m: 0.15, z_m: [0, 0.3]}]}\n"
    "      sensors:\n"
    "        - name: laser\n"
    "          driver: virtual_laser\n"
    "          mount: {z_m: 0.05}\n"
    "          period_s: 0.1\n"
    "          senses: [real_robots]\n"
    "          params: {fov_deg: 180, rays: 361, range_max_m: 6}\n";
constexpr const char* kHosts =
    "world_period_s: 0.05\n"
    "hosts:\n"
    "  - {name: lab, robots: [rosie]}\n"
    "  - {name: desk, robots: [ghost]}\n";

/// The shortest range of each reading of the ghost.
std::vector<float> nearest(const std::string& record) {
  std::vector<float> all;
  auto readings = cli_test::readings_of(record);
  for (const cli_test::Reading& reading : readings["ghost/laser"]) {
    const std::string& bytes = std::get<3>(reading);
    std::vector<float> ranges(bytes.size() / sizeof(float));
    std::memcpy(ranges.data(), bytes.data(), ranges.size() * sizeof(float));
    if (!ranges.empty()) all.push_back(*std::min_element(ranges.begin(), ranges.end()));
  }
  return all;
}

TEST(LiveCreate, ASimulatedRobotOfAnotherHostSeesItWhereItIs) {
  CreateRun run("create", 8, {"--clock-start-s", "3", "--drift-ppm", "200"}, kGhost, kHosts);
  run.start();
  EXPECT_EQ(run.rave->wait(), 0);
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  EXPECT_TRUE(result["whole"]) << result.dump();
  EXPECT_NE(result["no_hash_because"].get<std::string>().find("follows the wall clock"),
            std::string::npos);
  std::ifstream stream(run.file("out/console.log"));
  const std::string log{std::istreambuf_iterator<char>(stream), {}};
  EXPECT_NE(log.find("host `lab` is here, with 1 real and 0 simulated robots"), std::string::npos);
  EXPECT_NE(log.find("host `desk` is here, with 0 real and 1 simulated robots"), std::string::npos);
  const Json truth = run.await_state([](const Json& s) { return s["left_mps"] == 0.0; });
  EXPECT_GT(truth["path_m"], 0.2);

  const std::vector<float> seen = nearest(run.file("out/hosts/desk/run.mcap"));
  ASSERT_GT(seen.size(), 30U);
  EXPECT_LT(seen.back(), 6);
  const double away_m =
      std::hypot(truth["x"].get<double>() - kGhostX_m, truth["y"].get<double>() - kGhostY_m);
  // The body of the Create has 0.174 m; it rolled on a little after the run.
  EXPECT_NEAR(seen.back(), away_m - 0.174, 0.15);
  const auto [least, most] = std::minmax_element(seen.begin() + 10, seen.end());
  EXPECT_GT(*most - *least, 0.05) << "it moved";
}

}  // namespace
}  // namespace rave::tests
