// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/host/run.hpp"
#include "rave/sim/engine.hpp"

namespace rave::tests {

inline constexpr float kNoReturn = std::numeric_limits<float>::infinity();

/// Robot files with hybrid sensors, read, built and run as by `rave run`, with real plug-ins.
class HybridTest : public testing::Test {
 protected:
  /// A real robot whose first sensor says where it is.
  static std::string robot(const std::string& sensors, const std::string& mocap = "",
                           const std::string& rest = "") {
    return "{body: {shapes: [{disc_radius_m: 0.15, z_m: [0, 0.3]}]}, pose_from: mocap, "
           "actuators: [{name: wheels, driver: replay_ignored}], "
           "controllers: [{name: drive, driver: velocity, actuator: wheels}], "
           "sensors: [{name: mocap, driver: turning_pose, params: {" +
           mocap + "}}, " + sensors + "]" + rest + "}";
  }
  static std::string scenario(const std::string& robot_file, const std::string& world = "",
                              const std::string& others = "", const std::string& step_s = "0.01") {
    return "name: small\nduration_s: 1\nstep_s: " + step_s + "\n" + world +
           "robots:\n  - name: anna\n    robot: " + robot_file + "\n" + others;
  }
  /// A virtual box whose near side is `near_m` ahead of the origin.
  static std::string box_at(double near_m, const std::string& layer = "virtual_obstacles") {
    return "obstacles: [{name: box, box_m: [0.2, 1], x_m: " + std::to_string(near_m + 0.1) +
           ", y_m: 0, z_m: [0, 1], layer: " + layer + "}]\n";
  }

  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("rave_") + test->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    catalogue_ = std::make_unique<plugin::Catalogue>(runtime::host_stamp());
    const std::filesystem::path build(RAVE_BINARY_DIR);
    ASSERT_TRUE(catalogue_->add_folder(build / "lib/rave/plugins"));
    ASSERT_TRUE(catalogue_->add_folder(build / "tests/plugins/hybrid"));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Result<config::ExpandedScenario> expand(const std::string& text) {
    return config::expand_scenario_text(text, folder_ / "s.yaml");
  }
  Result<std::unique_ptr<sim::Engine>> make(const std::string& text) {
    RAVE_TRY_ASSIGN(const auto scenario, expand(text));
    RAVE_TRY_ASSIGN(auto built, runtime::build(scenario, *catalogue_, {}));
    return sim::Engine::create(std::move(built.spec));
  }
  std::unique_ptr<sim::Engine> engine_of(const std::string& text) {
    auto engine = make(text);
    if (!engine) ADD_FAILURE() << engine.error().text();
    return engine ? *std::move(engine) : nullptr;
  }
  /// Runs a scenario to its end, into the folder `run`.
  Result<runtime::RunOutcome> run(const std::string& text) {
    RAVE_TRY_ASSIGN(const auto expanded, expand(text));
    runtime::RunOptions options;
    options.output = folder_ / "run";
    options.picture = false;
    return runtime::run(expanded, *catalogue_, options);
  }
  /// What is wrong with a scenario, without the folder; "none" if nothing is.
  std::string error_of(const std::string& text) {
    const auto engine = make(text);
    if (engine) return "none";
    std::string all = engine.error().text();
    const std::string folder = folder_.string() + "/";
    for (auto at = all.find(folder); at != std::string::npos; at = all.find(folder)) {
      all.erase(at, folder.size());
    }
    return all;
  }
  static void steps(sim::Engine& engine, int count) {
    for (int i = 0; i < count; ++i) {
      const Status status = engine.step();
      ASSERT_TRUE(status) << status.error().text();
    }
  }
  static std::vector<float> ranges(const sim::Engine& engine, std::uint32_t sensor = 1) {
    const sim::SensorSample sample = engine.sensor(RobotId(0), sensor);
    const auto* const first = static_cast<const float*>(sample.records);
    return {first, first + sample.header->count};
  }
  /// The ranges of the robot's hybrid sensor after the first step.
  std::vector<float> first_ranges(const std::string& text) {
    const auto engine = engine_of(text);
    if (!engine) return {};
    steps(*engine, 1);
    return ranges(*engine);
  }

  std::filesystem::path folder_;
  std::unique_ptr<plugin::Catalogue> catalogue_;
};

/// One ray ahead: really 2.0 m.
inline std::string laser(const std::string& params = "", const std::string& real = "",
                         const std::string& virtual_part = "") {
  return "{name: eye, driver: hybrid_ranges, mount: {z_m: 0.1}, params: {" + params +
         "}, real: {driver: still_ranges, params: {" + real +
         "}}, virtual: {driver: virtual_laser, params: {rays: 1}" + virtual_part + "}}";
}

}  // namespace rave::tests
