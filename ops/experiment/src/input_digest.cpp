// SPDX-License-Identifier: Apache-2.0
#include "input_digest.hpp"

#include <fmt/format.h>

#include <array>
#include <set>
#include <span>

#include "rave/base/file.hpp"
#include "rave/base/hash.hpp"

namespace rave::experiment {
namespace {

std::uint64_t hash_of(std::string_view text) {
  return content_hash(std::as_bytes(std::span(text.data(), text.size())));
}

std::set<std::string> drivers_of(const sim::EngineSpec& built) {
  std::set<std::string> names;
  const auto add = [&names](const auto& parts) {
    for (const auto& part : parts) names.insert(part.driver);
  };
  for (const sim::RobotType& type : built.types) {
    add(type.devices);
    add(type.sensors);
    add(type.controllers);
    add(type.actuators);
    add(type.transmitters);
    add(type.communicators);
    if (type.program) names.insert(type.program->driver);
    for (const sim::SensorSpec& sensor : type.sensors) {
      if (sensor.hybrid) names.insert({sensor.hybrid->real_driver, sensor.hybrid->virtual_driver});
    }
  }
  return names;
}

/// Without the folders, which differ between machines.
void forget_folders(config::ExpandedScenario& scenario) {
  const auto name = [](const std::string& path) {
    return std::filesystem::path(path).filename().string();
  };
  for (config::RobotGroup& group : scenario.groups) {
    group.file = name(group.file);
    if (group.twin) group.twin->file = name(group.twin->file);
  }
  for (config::MapFile& map : scenario.world.maps) map.file.value = name(*map.file);
}

}  // namespace

Result<std::uint64_t> InputDigest::content(const std::filesystem::path& file) {
  const auto known = contents_.find(file.string());
  if (known != contents_.end()) return known->second;
  RAVE_TRY_ASSIGN(const std::string text, read_file(file));
  return contents_.emplace(file.string(), hash_of(text)).first->second;
}

Status InputDigest::add_plugins(const sim::EngineSpec& built, std::string& text) {
  constexpr std::array kKinds = {DriverKind::kSensor,          DriverKind::kVirtualSensor,
                                 DriverKind::kHybridSensor,    DriverKind::kActuator,
                                 DriverKind::kVirtualActuator, DriverKind::kController,
                                 DriverKind::kCommunicator,    DriverKind::kTransmitter,
                                 DriverKind::kProgram,         DriverKind::kDevice};
  static_assert(kKinds.size() == kDriverKindCount);
  for (const std::string& name : drivers_of(built)) {
    RAVE_TRY_ASSIGN(const plugin::Driver* const driver, catalogue_.find(kKinds, name));
    RAVE_TRY_ASSIGN(const std::uint64_t hash, content(driver->file));
    text += fmt::format("plug-in {} {:016x}\n", name, hash);
  }
  return {};
}

Result<std::string> InputDigest::of(config::ExpandedScenario scenario, const sim::EngineSpec& built,
                                    const config::ExperimentFile& experiment) {
  RAVE_TRY_ASSIGN(const std::uint64_t program, content(program_));
  std::string text = fmt::format("rave {:016x}\n", program);
  RAVE_TRY(add_plugins(built, text));
  for (const config::MetricFile& metric : experiment.metrics) {
    text += fmt::format("metric {} {}\n", *metric.value,
                        metric.absent ? fmt::format("{}", *metric.absent) : "");
  }
  for (const auto& [path, content] : scenario.files.all()) {
    text += fmt::format("file {} {:016x}\n", std::filesystem::path(path).filename().string(),
                        hash_of(*content));
  }
  scenario.scenario.seed = 0;
  forget_folders(scenario);
  text += config::write_expanded(scenario);
  return fmt::format("{:016x}", hash_of(text));
}

}  // namespace rave::experiment
