// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "rave/config/expanded_scenario.hpp"

namespace {

namespace config = rave::config;

/// Whatever can be read can be written, and what is written reads back as the same.
void check_robot(std::string_view text) {
  const auto robot = config::read_robot_text(text, "fuzz");
  if (!robot) {
    if (robot.error().message.empty()) std::abort();
    return;
  }
  const auto again = config::read_robot_text(config::write_robot(*robot), "again");
  if (!again || !(*again == *robot)) std::abort();
}

void check_world(std::string_view text) {
  const auto world = config::read_world_text(text, "fuzz");
  if (!world) return;
  const auto again = config::read_world_text(config::write_world(*world), "again");
  if (!again || !(*again == *world)) std::abort();
}

void check_gui(std::string_view text) {
  const auto gui = config::read_gui_text(text, "fuzz");
  if (gui ? gui->file.has_value() : gui.error().message.empty()) std::abort();
}

/// Whether expanding it opens no file.
bool stands_alone(const config::ScenarioFile& scenario) {
  return !scenario.world && !scenario.gui.file && scenario.maps.empty() &&
         std::all_of(scenario.robots.begin(), scenario.robots.end(),
                     [](const config::RobotEntry& entry) { return entry.robot.has_value(); });
}

void check_scenario(std::string_view text) {
  const auto scenario = config::read_scenario_text(text, "fuzz");
  if (!scenario || !stands_alone(*scenario)) return;
  const auto expanded = config::expand_scenario_text(text, "/fuzz/fuzz.yaml");
  if (!expanded) return;
  const auto again =
      config::expand_scenario_text(config::write_expanded(*expanded), "/again/again.yaml");
  if (!again || !(*again == *expanded)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  check_robot(text);
  check_world(text);
  check_gui(text);
  check_scenario(text);
  return 0;
}
