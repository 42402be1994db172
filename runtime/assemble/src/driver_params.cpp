// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "device_tools.hpp"

namespace rave::runtime {
namespace {

/// Parameters cross the edge of a plug-in as numbers, texts and lists of numbers only, so a bool or
/// an integer becomes a number. A double holds integers exactly up to 2^53.
struct AddValue {
  plugin::ParamSet& set;
  const std::string& name;

  void operator()(bool value) const { set.add_number(name, value ? 1 : 0); }
  void operator()(std::int64_t value) const { set.add_number(name, static_cast<double>(value)); }
  void operator()(double value) const { set.add_number(name, value); }
  void operator()(const std::string& value) const { set.add_text(name, value); }
  void operator()(const std::vector<double>& value) const { set.add_list(name, value); }
};

}  // namespace

Result<plugin::ParamSet> read_params(const plugin::Driver& driver, const codec::RawNode& params) {
  const auto specs = field_specs(driver.info);
  RAVE_TRY_ASSIGN(const auto values,
                  config::read_params(params, specs, fmt::format("driver `{}`", driver.info.name)));
  plugin::ParamSet set;
  for (const config::Param& param : values.all()) {
    std::visit(AddValue{set, param.name}, param.value);
  }
  return set;
}

Result<plugin::ParamSet> read_sensor_params(const DeviceContext& context,
                                            const plugin::Driver& driver,
                                            const codec::RawNode& params) {
  // A sensor with geographic coordinates needs the point of the Earth at which the world has its
  // origin. All sensors of a scenario must agree on it, so the scenario states it once; a value in
  // the robot file takes precedence.
  constexpr std::string_view kOrigin = "geo_origin";
  const auto& origin = context.scenario.scenario.geo_origin;
  const auto specs = driver.info.param_specs();
  const bool wants = std::any_of(specs.begin(), specs.end(),
                                 [&](const ParamSpec& spec) { return spec.name == kOrigin; });
  if (!wants || !origin || params.find(kOrigin) != nullptr) return read_params(driver, params);
  codec::RawNode numbers = codec::RawNode::sequence();
  for (const double number :
       {origin->latitude_deg, origin->longitude_deg, origin->altitude_m, origin->yaw_deg}) {
    numbers.push_back(codec::RawNode::number(number));
  }
  codec::RawNode all = params.is_mapping() ? params : codec::RawNode::mapping();
  all.append(std::string(kOrigin), std::move(numbers));
  return read_params(driver, all);
}

config::FieldSpec field_spec(const ParamSpec& spec) {
  config::FieldSpec field;
  field.name = spec.name;
  field.doc = spec.doc;
  field.unit = spec.unit;
  const bool numeric = spec.type == ParamType::kInteger || spec.type == ParamType::kNumber ||
                       spec.type == ParamType::kNumbers;
  if (numeric && std::isfinite(spec.min)) field.min = spec.min;
  if (numeric && std::isfinite(spec.max)) field.max = spec.max;
  switch (spec.type) {
    case ParamType::kBool:
      field.type = config::ParamType::kBool;
      field.default_value = spec.default_number != 0;
      break;
    case ParamType::kInteger:
      field.type = config::ParamType::kInt;
      field.default_value = static_cast<std::int64_t>(spec.default_number);
      break;
    case ParamType::kNumber:
      field.type = config::ParamType::kDouble;
      field.default_value = spec.default_number;
      break;
    case ParamType::kText:
      field.type = config::ParamType::kString;
      field.default_value = std::string(spec.default_text);
      break;
    case ParamType::kChoice:
      field.type = config::ParamType::kEnum;
      field.choices.assign(spec.choices, spec.choices + spec.choice_count);
      field.default_value = std::string(spec.default_text);
      break;
    case ParamType::kNumbers:
      field.type = config::ParamType::kDoubleList;
      // The interface has no default for lists: an empty list means that nothing was given.
      field.default_value = std::vector<double>{};
      break;
  }
  // The absence of a default makes the reader insist on the value.
  if (spec.required != 0) field.default_value.reset();
  return field;
}

std::vector<config::FieldSpec> field_specs(const DriverInfo& info) {
  std::vector<config::FieldSpec> fields;
  for (const ParamSpec& spec : info.param_specs()) fields.push_back(field_spec(spec));
  return fields;
}

}  // namespace rave::runtime
