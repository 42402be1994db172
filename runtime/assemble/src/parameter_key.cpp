// SPDX-License-Identifier: Apache-2.0
#include "rave/assemble/parameter_key.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "rave/assemble/devices.hpp"
#include "rave/base/names.hpp"

namespace rave::runtime {
namespace {

using Part = sim::ParameterChange::Part;

/// One changeable parameter.
struct Known {
  std::string key;
  Part part = Part::kProgram;
  std::uint32_t index = 0;
  const ParamSpec* spec = nullptr;
};

void add(std::vector<Known>& all, const std::string& prefix, Part part, std::uint32_t index,
         std::span<const ParamSpec> specs) {
  for (const ParamSpec& spec : specs) {
    all.push_back({fmt::format("{}.{}", prefix, spec.name), part, index, &spec});
  }
}

std::vector<Known> known_parameters(const sim::RobotType& type) {
  std::vector<Known> all;
  if (type.program) add(all, "program", Part::kProgram, 0, type.program->param_specs);
  for (std::uint32_t i = 0; i < type.controllers.size(); ++i) {
    add(all, "controller." + type.controllers[i].name, Part::kController, i,
        type.controllers[i].param_specs);
  }
  for (std::uint32_t i = 0; i < type.actuators.size(); ++i) {
    // The parameters of a hardware actuator are those of the device, such as its port. They are
    // read once, when the driver opens it.
    if (type.actuators[i].virtual_ops == nullptr) continue;
    add(all, "actuator." + type.actuators[i].name, Part::kActuator, i,
        type.actuators[i].param_specs);
  }
  // A real body cannot change its size.
  if (type.simulated) add(all, "body", Part::kBody, 0, sim::body_params());
  return all;
}

struct ToValue {
  sim::ParameterValue operator()(bool value) const { return value ? 1.0 : 0.0; }
  sim::ParameterValue operator()(std::int64_t value) const { return static_cast<double>(value); }
  sim::ParameterValue operator()(double value) const { return value; }
  sim::ParameterValue operator()(const std::string& value) const { return value; }
  sim::ParameterValue operator()(const std::vector<double>& value) const { return value; }
};

std::string text_of(const ParamSpec& spec, const ParamValue& value) {
  switch (spec.type) {
    case ParamType::kBool:
      return value.number != 0 ? "true" : "false";
    case ParamType::kText:
    case ParamType::kChoice:
      return value.text;
    case ParamType::kNumbers:
      return sim::to_string(std::vector<double>(value.list, value.list + value.list_size));
    default:
      return sim::to_string(value.number);
  }
}

/// The initial values of the part that a parameter belongs to.
std::span<const ParamValue> values_of(const sim::RobotType& type, const Known& known) {
  switch (known.part) {
    case Part::kProgram:
      return type.program->params.values();
    case Part::kController:
      return type.controllers[known.index].params.values();
    case Part::kActuator:
      return type.actuators[known.index].params.values();
    case Part::kBody:
      break;
  }
  return {};
}

}  // namespace

Result<RobotId> find_robot(const sim::EngineSpec& spec, std::string_view name) {
  std::vector<std::string_view> names;
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    if (spec.robots[r].name == name) return RobotId(r);
    names.emplace_back(spec.robots[r].name);
  }
  return fail(ErrorCode::kNotFound, "there is no robot `{}`{}", name, suggestion(name, names));
}

Result<sim::ParameterChange> parse_change(const sim::RobotType& type, std::string_view key,
                                          const codec::RawNode& value) {
  const std::vector<Known> all = known_parameters(type);
  for (const Known& known : all) {
    if (known.key != key) continue;
    // The value passes the same reader as a robot file: same types, ranges and messages.
    const std::vector<config::FieldSpec> specs{field_spec(*known.spec)};
    codec::RawNode params = codec::RawNode::mapping();
    params.append(known.spec->name, value);
    auto values = config::read_params(params, specs, fmt::format("`{}`", key));
    if (!values) {
      Error error = std::move(values).error();
      if (error.where.file.empty()) error.where = value.where();
      return tl::unexpected(std::move(error));
    }
    sim::ParameterChange change;
    change.part = known.part;
    change.index = known.index;
    change.name = known.spec->name;
    change.value = std::visit(ToValue{}, values->all().front().value);
    return change;
  }
  std::vector<std::string_view> keys;
  for (const Known& known : all) keys.emplace_back(known.key);
  Error error{ErrorCode::kNotFound,
              fmt::format("there is no parameter `{}`{}", key, suggestion(key, keys)),
              value.where()};
  return tl::unexpected(std::move(error));
}

std::vector<ChangeableParameter> changeable_parameters(const sim::RobotType& type) {
  std::vector<ChangeableParameter> all;
  for (const Known& known : known_parameters(type)) all.push_back({known.key, known.spec});
  return all;
}

std::vector<std::pair<std::string, std::string>> first_values(const sim::RobotType& type) {
  std::vector<std::pair<std::string, std::string>> texts;
  for (const Known& known : known_parameters(type)) {
    if (known.part == Part::kBody) {
      // Parameters of the body are scale factors relative to its file.
      texts.emplace_back(known.key, "1");
      continue;
    }
    const auto values = values_of(type, known);
    const auto value = std::ranges::find_if(values, [&](const ParamValue& one) {
      return known.spec->name == std::string_view(one.name);
    });
    if (value != values.end()) texts.emplace_back(known.key, text_of(*known.spec, *value));
  }
  return texts;
}

std::vector<std::pair<std::string, std::string>> changed_values(const sim::Engine& engine,
                                                                RobotId robot) {
  std::vector<std::pair<std::string, std::string>> changed;
  if (!engine.has_changed_parameters(robot)) return changed;
  const sim::EngineSpec& spec = engine.spec();
  const sim::RobotType& type = spec.types[spec.robots[robot.value()].type];
  const auto first = first_values(type);
  for (const Known& known : known_parameters(type)) {
    std::string value = engine.parameter(robot, known.part, known.index, known.spec->name);
    // Nothing is known of a part that has failed.
    if (value.empty() && known.spec->type != ParamType::kText) continue;
    std::pair entry(known.key, std::move(value));
    if (std::ranges::find(first, entry) == first.end()) changed.push_back(std::move(entry));
  }
  return changed;
}

}  // namespace rave::runtime
