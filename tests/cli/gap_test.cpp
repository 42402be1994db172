// SPDX-License-Identifier: Apache-2.0
// A recorded robot against its simulated twin: nothing for the robot itself, and what geometry says
// for a twin that is off by a known share.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "process.hpp"

namespace rave::cli_test {
namespace {

using nlohmann::json;

/// A robot that drives a circle for a long way: v = 0.4 m/s, w = 0.1 rad/s would do, but no program
/// gives that; two goals far away make a straight line and are as good.
constexpr const char* kBody = R"(
body: {shapes: [{disc_radius_m: 0.1, z_m: [0, 0.2]}]}
)";
constexpr const char* kController = R"(
controllers: [{name: drive, driver: velocity, actuator: wheels}]
program: {driver: wander, period_s: 0.1, params: {cruise_mps: 0.3}}
sensors:
  - {name: laser, driver: virtual_laser, mount: {z_m: 0.1}, period_s: 0.1, params: {rays: 5, fov_deg: 100, range_max_m: 1}}
  - {name: bumper, driver: virtual_contact, period_s: 0.1}
)";

class Gap : public testing::Test {
 protected:
  /// A robot file whose wheels slip all the time by `share`.
  std::filesystem::path robot_file(const std::string& name, const std::string& actuator) {
    std::filesystem::path path = folder_.path() / (name + ".yaml");
    std::ofstream(path) << kBody << "actuators: [" << actuator << "]\n" << kController;
    return path;
  }
  static std::string dynamic(const std::string& more) {
    return "{name: wheels, driver: differential_drive_dynamic, params: {wheel_separation_m: 0.2, "
           "max_wheel_speed_mps: 1, natural_frequency_radps: 200, damping_ratio: 1, "
           "max_wheel_acceleration_mps2: 1000" +
           more + "}}";
  }
  void record(const std::filesystem::path& robot, const std::string& more = "") {
    std::ofstream(folder_.path() / "scenario.yaml")
        << "name: alone\nduration_s: 65\nrobots:\n  - {name: it, file: " << robot.string()
        << ", pose: {x_m: 1, y_m: 2, yaw_deg: 30}}\n"
        << more;
    const Ended ended = run_rave({"run", folder_.path() / "scenario.yaml", "--output",
                                  folder_.path() / "run", "--no-picture", "--quiet"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
  }
  json gap(std::vector<std::string> words = {}) {
    words.insert(words.begin(), {"report", "gap", folder_.path() / "run", "--json"});
    const Ended ended = run_rave(words);
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    return json::parse(ended.out, nullptr, false);
  }

  TemporaryFolder folder_;
};

TEST_F(Gap, ARobotIsItsOwnTwin) {
  record(robot_file("robot", dynamic(", slip_probability_per_s: 0.5, slip_factor: 0.5")));
  const json report = gap();
  ASSERT_TRUE(report.is_object());
  ASSERT_EQ(report["after"].size(), 4U);
  EXPECT_EQ(report["after"][2]["after_s"], 60.0);
  EXPECT_GT(report["driven_m"], 5.0);
  // Slips by chance, and the twin draws the same.
  EXPECT_EQ(report["largest"]["m"], 0.0);
  EXPECT_EQ(report["largest_deg"], 0.0);
  EXPECT_EQ(report["rms_m"], 0.0);
  EXPECT_EQ(report["windows"]["count"], 6);
  EXPECT_EQ(report["windows"]["p95_m"], 0.0);
  for (const char* const file : {"gap-it.svg", "gap-it.png", "gap-it.json"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "run" / file)) << file;
  }
}

TEST_F(Gap, WheelsThatSlipByTwoPercentFallBehindByTwoPercent) {
  record(robot_file("robot", dynamic("")));
  const auto twin =
      robot_file("slipping",
                 dynamic(", slip_probability_per_s: 1000, slip_duration_s: 60, slip_factor: 0.98"));
  const json report = gap({"--twin", twin});
  ASSERT_TRUE(report.is_object());
  // Nothing is in its way, so it drives a straight line at 0.3 m/s or, where it turns, an arc whose
  // length and angle are 2 % short. Windows that start anew show it without what adds up.
  const double way_m = 0.3 * 10;
  EXPECT_NEAR(report["windows"]["median_m"], 0.02 * way_m, 0.04 * 0.02 * way_m);
  EXPECT_NEAR(report["driven_m"], 0.98 * 0.3 * report["duration_s"].get<double>(), 0.2);
  EXPECT_GT(report["after"][2]["m"], report["after"][0]["m"]);
}

TEST_F(Gap, WhatWasNotMeasuredIsNoNumber) {
  record(robot_file("robot", dynamic("")));
  const json report = gap({"--window", "100"});
  ASSERT_TRUE(report.is_object());
  EXPECT_EQ(report["windows"]["count"], 0);
  for (const char* const key : {"median_m", "p95_m", "median_deg", "p95_deg"}) {
    EXPECT_EQ(report["windows"][key], nullptr) << key;
  }
  EXPECT_EQ(report["steps_with_pose"], report["steps"]);
}

TEST_F(Gap, TheTableNamesTheMoments) {
  record(robot_file("robot", dynamic("")));
  const Ended ended = run_rave({"report", "gap", folder_.path() / "run"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* const words :
       {"after 10 s", "after 30 s", "after 60 s", "largest", "RMS", "median of 6 windows of 10 s",
        "95 % of 6 windows", "`differential_drive_dynamic` of its own file",
        "what reached the actuator"}) {
    EXPECT_NE(ended.out.find(words), std::string::npos) << words << "\n" << ended.out;
  }
}

TEST(GapOfARecording, ItsCommandsAreASensor) {
  const TemporaryFolder folder;
  const std::string run = folder.path() / "run";
  ASSERT_NE(run_rave({"run", "../../../scenarios/mixed-reality", "--duration", "30", "--output",
                      run, "--no-picture", "--quiet"})
                .exit_code,
            2);
  const std::string twin = RAVE_SOURCE_DIR "/robots/wanderer.yaml";
  const Ended deaf = run_rave({"report", "gap", run, "--robot", "real-3", "--twin", twin});
  EXPECT_EQ(deaf.exit_code, 2);
  EXPECT_NE(deaf.err.find("which ignored its commands; --commands takes one of its sensors: "
                          "commanded"),
            std::string::npos)
      << deaf.err;
  const Ended ended = run_rave({"report", "gap", run, "--robot", "real-3", "--twin", twin,
                                "--commands", "commanded", "--json"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const json report = json::parse(ended.out, nullptr, false);
  ASSERT_TRUE(report.is_object());
  // A real robot is not its kinematic twin, and not far from it either.
  EXPECT_GT(report["driven_m"], 0.5);
  EXPECT_GT(report["windows"]["median_m"], 0.001);
  EXPECT_LT(report["windows"]["median_m"], 0.5 * report["driven_m"].get<double>());
}

TEST(GapErrors, SayWhatIsMissing) {
  const TemporaryFolder folder;
  const std::string run = folder.path() / "run";
  ASSERT_EQ(run_rave({"run", "played.yaml", "--duration", "0.5", "--output", run, "--no-picture",
                      "--quiet"})
                .exit_code,
            0);
  const auto error = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"report", "gap", run});
    const Ended ended = run_rave(words);
    EXPECT_EQ(ended.exit_code, 2);
    return ended.err;
  };
  EXPECT_NE(error({}).find("choose one with --robot: anna, bert"), std::string::npos);
  EXPECT_NE(error({"--robot", "brt"}).find("did you mean `bert`?"), std::string::npos);
  EXPECT_NE(error({"--robot", "bert", "--commands", "odometry"}).find("gives odometry"),
            std::string::npos);
  EXPECT_NE(error({"--robot", "bert", "--twin", "nowhere.yaml"}).find("nowhere.yaml"),
            std::string::npos);
}

}  // namespace
}  // namespace rave::cli_test
