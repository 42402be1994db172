// SPDX-License-Identifier: Apache-2.0
#include "live/parameters_json.hpp"

#include <map>
#include <nlohmann/json.hpp>

#include "rave/assemble/parameter_key.hpp"
#include "rave/base/json_text.hpp"
#include "rave/base/word_table.hpp"

namespace rave::gui_server {
namespace {

using ParameterJson = nlohmann::ordered_json;
/// Each robot has the list in the roster, which would be megabytes for a swarm.
constexpr std::size_t kMostDescribed = 256;

constexpr WordTable<ParamType, 6> kKinds = {{{"flag", ParamType::kBool},
                                             {"integer", ParamType::kInteger},
                                             {"number", ParamType::kNumber},
                                             {"choice", ParamType::kChoice},
                                             {"text", ParamType::kText},
                                             {"numbers", ParamType::kNumbers}}};

/// The value of a file as JSON has it; null: the file gives none.
ParameterJson first_value(const ParamSpec& spec, const std::string& text) {
  if (spec.type == ParamType::kText || spec.type == ParamType::kChoice) return text;
  return ParameterJson::parse(text, nullptr, false);
}

/// Null: a list, which no control of the page shows for what is changed while a robot runs.
ParameterJson parameter_json(const ParamSpec& spec, const std::string& key, bool lists = false) {
  const std::string_view kind = kKinds.of(spec.type);
  if (kind.empty() || (spec.type == ParamType::kNumbers && !lists)) return nullptr;
  ParameterJson json = {{"key", key}, {"kind", kind}};
  if (spec.type == ParamType::kChoice) {
    json["choices"] = std::vector<std::string>(spec.choices, spec.choices + spec.choice_count);
  }
  json["unit"] = spec.unit;
  json["doc"] = spec.doc;
  const bool counts = spec.type == ParamType::kNumber || spec.type == ParamType::kInteger ||
                      spec.type == ParamType::kNumbers;
  if (counts && spec.min < spec.max) json["range"] = ParameterJson::array({spec.min, spec.max});
  return json;
}

ParameterJson parameters_of(const sim::RobotType& type) {
  std::map<std::string, std::string> values;
  for (auto& [key, text] : runtime::first_values(type)) values[key] = std::move(text);
  ParameterJson all = ParameterJson::array();
  for (const auto& parameter : runtime::changeable_parameters(type)) {
    ParameterJson json = parameter_json(*parameter.spec, parameter.key);
    if (json.is_null()) continue;
    if (const auto value = values.find(parameter.key); value != values.end()) {
      const ParameterJson first = first_value(*parameter.spec, value->second);
      if (!first.is_discarded() && first.is_primitive() && !first.is_null()) json["value"] = first;
    }
    all.push_back(std::move(json));
  }
  return all;
}

ParameterJson twin_json(const sim::RobotType& type) {
  ParameterJson json = {{"kind", type.simulated ? "simulated" : "real"},
                        {"drivers", ParameterJson::array()},
                        {"sensors", ParameterJson::array()}};
  for (const sim::ActuatorSpec& actuator : type.actuators)
    json["drivers"].push_back(actuator.driver);
  for (const sim::SensorSpec& sensor : type.sensors) {
    const char* const origin =
        sensor.hybrid ? "hybrid" : (sensor.virtual_ops != nullptr ? "virtual" : "real");
    json["sensors"].push_back({{"driver", sensor.driver}, {"origin", origin}});
  }
  return json;
}

}  // namespace

std::string described_json(const ParamSpec& spec) {
  ParameterJson json = parameter_json(spec, spec.name, true);
  if (json.is_null()) return "{}";
  if (spec.required == 0) {
    switch (spec.type) {
      case ParamType::kBool:
        json["value"] = spec.default_number != 0;
        break;
      case ParamType::kInteger:
        json["value"] = static_cast<std::int64_t>(spec.default_number);
        break;
      case ParamType::kNumber:
        json["value"] = spec.default_number;
        break;
      case ParamType::kText:
      case ParamType::kChoice:
        json["value"] = spec.default_text;
        break;
      default:
        break;
    }
  }
  return json_text(json);
}

std::string with_parameters(const std::string& robots_json, const sim::EngineSpec& spec) {
  if (spec.robots.size() > kMostDescribed) return robots_json;
  ParameterJson robots = ParameterJson::parse(robots_json);
  std::map<std::size_t, ParameterJson> known;
  for (std::size_t r = 0; r < std::min(robots.size(), spec.robots.size()); ++r) {
    const std::size_t type = spec.robots[r].type;
    // Robots of a type have the same parameters.
    const auto [found, is_new] = known.try_emplace(type);
    if (is_new) found->second = parameters_of(spec.types[type]);
    robots[r]["parameters"] = found->second;
    if (spec.robots[r].twin) robots[r]["twin"] = twin_json(spec.types[*spec.robots[r].twin]);
  }
  return json_text(robots);
}

}  // namespace rave::gui_server
