// SPDX-License-Identifier: Apache-2.0
#include "live/probe_desk.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "live/parameters_json.hpp"
#include "rave/base/json_text.hpp"
#include "rave/math/scalar.hpp"
#include "rave/probe/probe_block.hpp"
#include "rave/sim/lone_sensor.hpp"
#include "run/reading_json.hpp"

namespace rave::gui_server {
namespace {

using ProbeJson = nlohmann::ordered_json;
constexpr std::uint32_t kNumbers = 0x3fff'ffffU;
constexpr const char* kWithoutObstacles = "senses: [mapped_real, simulated_robots, real_robots]";

/// What a file has in each line of the entry, from its name on.
std::vector<std::string> lines_of(const ProbeRequest& request) {
  // Degrees as the person typed them, although they came in radians.
  const double yaw_deg = std::round(rad_to_deg(request.X_RS.yaw) * 1e6) / 1e6;
  std::vector<std::string> lines = {
      "name: " + request.name, "driver: " + request.driver,
      fmt::format("mount: {{x_m: {}, y_m: {}, z_m: {}, yaw_deg: {}}}", request.X_RS.x,
                  request.X_RS.y, request.z_m, yaw_deg)};
  if (request.without_obstacles) lines.emplace_back(kWithoutObstacles);
  std::vector<std::string> params;
  for (const auto& [name, value] : request.params)
    params.push_back(fmt::format("{}: {}", name, value));
  if (!params.empty()) lines.push_back(fmt::format("params: {{{}}}", fmt::join(params, ", ")));
  return lines;
}

ProbeJson sensor_of(const sim::LoneSensor& sensor) {
  const SensorInfo& info = sensor.info();
  ProbeJson json = {{"name", info.name},
                    {"origin", "virtual"},
                    {"driver", sensor.spec().driver},
                    {"mount", ProbeJson::array({info.X_RS.x, info.X_RS.y, info.X_RS.yaw})},
                    {"z", info.z_m},
                    {"period_s", info.period_s}};
  add_reading_type(json, info.kind);
  if (info.kind == ReadingKind::kRanges && info.bearings_rad != nullptr) {
    json["range"] = ProbeJson::array({info.range_min_m, info.range_max_m});
    json["bearings"] = std::vector<double>(info.bearings_rad, info.bearings_rad + info.capacity);
    json["cone"] = info.cone_rad;
  }
  return json;
}

ProbeJson driver_of(const DriverInfo& info) {
  ProbeJson driver = {{"name", info.name},
                      {"summary", info.summary},
                      {"kind", std::string(to_string(static_cast<ReadingKind>(info.data_kind)))},
                      {"parameters", ProbeJson::array()}};
  for (const ParamSpec& spec : info.param_specs()) {
    driver["parameters"].push_back(ProbeJson::parse(described_json(spec)));
  }
  return driver;
}

}  // namespace

ProbeDesk::ProbeDesk(std::unique_ptr<plugin::Catalogue> catalogue, double step_s)
    : catalogue_(std::move(catalogue)),
      step_s_(step_s),
      // Another server beside this one uses others.
      next_(std::random_device()() & kNumbers) {}

const std::string& ProbeDesk::catalogue_json() {
  if (!json_.empty()) return json_;
  ProbeJson drivers = ProbeJson::array();
  for (const plugin::Driver* const driver : catalogue_->all()) {
    if (driver->info.kind == DriverKind::kVirtualSensor) drivers.push_back(driver_of(driver->info));
  }
  return json_ = json_text(drivers);
}

Result<ProbeMade> ProbeDesk::make(const ProbeRequest& request, std::uint32_t robot) {
  const std::vector<std::string> lines = lines_of(request);
  ProbeMade made;
  made.asked.robot = robot;
  made.asked.block = fmt::format("{{{}}}", fmt::join(lines, ", "));
  made.text = fmt::format("  - {}\n", fmt::join(lines, "\n    "));
  RAVE_TRY_ASSIGN(auto spec, probe::read_block(made.asked.block, *catalogue_));
  RAVE_TRY_ASSIGN(const auto sensor, sim::LoneSensor::make(std::move(spec), step_s_));
  made.asked.number = probe::kProbeBit | (next_++ & kNumbers);
  if (sensor->info().kind == ReadingKind::kNeighbours) {
    made.asked.number |= probe::kNamesRobotsBit;
  }
  made.sensor_json = json_text(sensor_of(*sensor));
  return made;
}

}  // namespace rave::gui_server
