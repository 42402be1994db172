// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>

#include "rave/assemble/build.hpp"
#include "rave/sim/engine.hpp"

/// Scenarios from text, served by the plug-ins of this build.
namespace rave::runtime::testing {

inline const std::filesystem::path kFolder = std::filesystem::path(RAVE_SOURCE_DIR) / "scenarios";

/// A simulated robot that goes straight ahead slowly, for the place of a robot entry.
inline const std::string kBody = "body: {shapes: [{disc_radius_m: 0.15, z_m: [0, 0.2]}]}";
inline const std::string kWheels =
    "actuators: [{name: wheels, driver: differential_drive}], "
    "controllers: [{name: drive, driver: velocity, actuator: wheels}]";

inline std::string scenario_text(const std::string& robots, const std::string& rest = {}) {
  return "name: small\nduration_s: 1\n" + rest + "robots:\n" + robots;
}

/// A catalogue of the plug-ins that were built, and what a scenario became with it.
class Host {
 public:
  Host() : catalogue_(host_stamp()) {
    const Status status =
        catalogue_.add_folder(std::filesystem::path(RAVE_BINARY_DIR) / "lib/rave/plugins");
    if (!status) ADD_FAILURE() << status.error().text();
  }

  [[nodiscard]] plugin::Catalogue& catalogue() { return catalogue_; }

  [[nodiscard]] Result<config::ExpandedScenario> expand(const std::string& text) {
    return config::expand_scenario_text(text, kFolder / "s.yaml");
  }

  [[nodiscard]] Result<BuiltScenario> build_text(const std::string& text) {
    RAVE_TRY_ASSIGN(const auto scenario, expand(text));
    return build(scenario, catalogue_, {});
  }

  /// What is wrong with a scenario, without the folder of the checkout; "none" if nothing is.
  [[nodiscard]] std::string error_of(const std::string& text) {
    const auto built = build_text(text);
    if (built) return "none";
    std::string all = built.error().text();
    const std::string folder = kFolder.string() + "/";
    for (auto at = all.find(folder); at != std::string::npos; at = all.find(folder)) {
      all.erase(at, folder.size());
    }
    return all;
  }

  [[nodiscard]] std::unique_ptr<sim::Engine> engine_of(const std::string& text) {
    auto built = build_text(text);
    if (!built) {
      ADD_FAILURE() << built.error().text();
      return nullptr;
    }
    kinds_ = built->robot_kinds;
    auto engine = sim::Engine::create(std::move(built->spec));
    if (!engine) ADD_FAILURE() << engine.error().text();
    return engine ? *std::move(engine) : nullptr;
  }
  [[nodiscard]] const std::vector<std::string>& kinds() const { return kinds_; }

 private:
  plugin::Catalogue catalogue_;
  std::vector<std::string> kinds_;
};

}  // namespace rave::runtime::testing
