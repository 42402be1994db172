// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>

#include "rave/assemble/build.hpp"
#include "rave/base/log.hpp"
#include "rave/host/run.hpp"
#include "rave/sim/engine.hpp"

namespace rave::tests {

/// Real scenarios with the real plug-ins of the build, run inside the test.
class ScenarioTest : public testing::Test {
 protected:
  static config::ExpandedScenario load(std::string_view name) {
    const auto path = std::filesystem::path(RAVE_SOURCE_DIR) / "scenarios" / name / "scenario.yaml";
    auto scenario = config::expand_scenario(path);
    EXPECT_TRUE(scenario) << (scenario ? "" : scenario.error().text());
    return scenario.value_or(config::ExpandedScenario{});
  }

  /// Expects that the page of a scenario says `words`, so that its figures are those of the
  /// program.
  static void expect_on_page(std::string_view scenario, const std::string& words) {
    const auto path = std::filesystem::path(RAVE_SOURCE_DIR) / "scenarios" / scenario / "README.md";
    std::ifstream file(path);
    const std::string page(std::istreambuf_iterator<char>(file), {});
    EXPECT_NE(page.find(words), std::string::npos) << path << " does not say: " << words;
  }

  static std::unique_ptr<plugin::Catalogue> plugins() {
    auto catalogue = std::make_unique<plugin::Catalogue>(runtime::host_stamp());
    EXPECT_TRUE(catalogue->add_folder(std::filesystem::path(RAVE_BINARY_DIR) / "lib/rave/plugins"));
    return catalogue;
  }

  /// An engine for a scenario, with the catalogue that its drivers live in.
  struct World {
    std::unique_ptr<plugin::Catalogue> catalogue;
    std::unique_ptr<sim::Engine> engine;

    void run_until(double end_s) const {
      while (engine->time().seconds() < end_s - 1e-9 || engine->steps_done() == 0) {
        const Status status = engine->step();
        ASSERT_TRUE(status) << status.error().text();
      }
    }
  };
  World make_world(const config::ExpandedScenario& scenario) {
    World world{plugins(), nullptr};
    auto built = runtime::build(scenario, *world.catalogue, options());
    EXPECT_TRUE(built) << (built ? "" : built.error().text());
    if (!built) return world;
    built->spec.live_clock = nullptr;
    // So few robots would otherwise be left to one thread, whatever the scenario asks for.
    built->spec.share_always = true;
    auto engine = sim::Engine::create(std::move(built->spec));
    EXPECT_TRUE(engine) << (engine ? "" : engine.error().text());
    if (engine) world.engine = *std::move(engine);
    return world;
  }

  runtime::BuildOptions options() {
    return {std::filesystem::path(RAVE_BINARY_DIR) / "bin/rave-program-runner", &log_, nullptr};
  }

  runtime::RunOutcome run(const config::ExpandedScenario& scenario, bool picture = false) {
    const auto catalogue = plugins();
    runtime::RunOptions options;
    options.output = folder_;
    options.program_runner = std::filesystem::path(RAVE_BINARY_DIR) / "bin/rave-program-runner";
    options.picture = picture;
    options.log = &log_;
    auto outcome = runtime::run(scenario, *catalogue, options);
    EXPECT_TRUE(outcome) << (outcome ? "" : outcome.error().text());
    return outcome.value_or(runtime::RunOutcome{});
  }

  static std::uint32_t robot_named(const sim::Engine& engine, std::string_view name) {
    for (std::uint32_t r = 0; r < engine.spec().robots.size(); ++r) {
      if (engine.spec().robots[r].name == name) return r;
    }
    ADD_FAILURE() << "no robot " << name;
    return 0;
  }
  static std::uint32_t sensor_named(const sim::Engine& engine, std::uint32_t robot,
                                    std::string_view name) {
    const auto& sensors = engine.spec().types[engine.spec().robots[robot].type].sensors;
    for (std::uint32_t s = 0; s < sensors.size(); ++s) {
      if (sensors[s].name == name) return s;
    }
    ADD_FAILURE() << "no sensor " << name;
    return 0;
  }

  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("rave_") + test->name() + "_" + std::to_string(::getpid()));
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  NullLogSink log_;
  std::filesystem::path folder_;
};

}  // namespace rave::tests
