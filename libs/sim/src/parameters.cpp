// SPDX-License-Identifier: Apache-2.0
// Values of parameters that people change during a run, checked against what the plug-in declared.
#include "parameters.hpp"

#include <algorithm>
#include <cmath>

#include "rave/base/names.hpp"

namespace rave::sim {
namespace {

constexpr ParamSpec kBodyParams[] = {
    number_param("scale", "", 1, 0.05, 20, "Scale of the outline about the origin of the robot."),
};

Status wrong_type(const ParamSpec& spec, std::string_view expected) {
  return fail(ErrorCode::kInvalidArgument, "`{}`: expected {}", spec.name, expected);
}

Status check_number(const ParamSpec& spec, double value, std::string_view unit) {
  if (std::isfinite(value) && value >= spec.min && value <= spec.max) return {};
  return fail(ErrorCode::kInvalidArgument, "`{}`: found {}, expected {} to {}{}{}", spec.name,
              value, spec.min, spec.max, unit.empty() ? "" : " ", unit);
}

Status check_choice(const ParamSpec& spec, const std::string& value) {
  const std::vector<std::string_view> choices(spec.choices, spec.choices + spec.choice_count);
  if (std::find(choices.begin(), choices.end(), value) != choices.end()) return {};
  return fail(ErrorCode::kInvalidArgument, "`{}`: there is no choice `{}`{}", spec.name, value,
              suggestion(value, choices));
}

const ParamValue* find(std::span<const ParamValue> values, std::string_view name) {
  for (const ParamValue& value : values) {
    if (name == value.name) return &value;
  }
  return nullptr;
}

void add(plugin::ParamSet& set, const ParamSpec& spec, const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    set.add_number(spec.name, *number);
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    set.add_text(spec.name, *text);
  } else {
    set.add_list(spec.name, std::get<std::vector<double>>(value));
  }
}

ParameterValue value_of(const ParamSpec& spec, const ParamValue& value) {
  switch (spec.type) {
    case ParamType::kText:
    case ParamType::kChoice:
      return std::string(value.text);
    case ParamType::kNumbers:
      return std::vector<double>(value.list, value.list + value.list_size);
    default:
      return value.number;
  }
}

}  // namespace

std::span<const ParamSpec> body_params() noexcept { return kBodyParams; }

std::string to_string(const ParameterValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  const auto& list = std::get<std::vector<double>>(value);
  std::string joined;
  for (const double number : list) {
    joined += fmt::format("{}{}", joined.empty() ? "" : ", ", number);
  }
  return "[" + joined + "]";
}

Status check_value(const ParamSpec& spec, const ParameterValue& value) {
  const auto* const number = std::get_if<double>(&value);
  const auto* const text = std::get_if<std::string>(&value);
  const auto* const list = std::get_if<std::vector<double>>(&value);
  switch (spec.type) {
    case ParamType::kBool:
      if (number == nullptr || (*number != 0 && *number != 1)) {
        return wrong_type(spec, "true or false");
      }
      return {};
    case ParamType::kInteger:
      // Whole numbers are kept as doubles, exactly up to 2^53.
      if (number == nullptr || *number != std::floor(*number)) {
        return wrong_type(spec, "a whole number");
      }
      return check_number(spec, *number, spec.unit);
    case ParamType::kNumber:
      if (number == nullptr) return wrong_type(spec, "a number");
      return check_number(spec, *number, spec.unit);
    case ParamType::kText:
      return text != nullptr ? Status{} : wrong_type(spec, "a text");
    case ParamType::kChoice:
      return text != nullptr ? check_choice(spec, *text) : wrong_type(spec, "a choice");
    case ParamType::kNumbers:
      if (list == nullptr) return wrong_type(spec, "a list of numbers");
      for (const double item : *list) RAVE_TRY(check_number(spec, item, spec.unit));
      return {};
  }
  return wrong_type(spec, "a known type");
}

Result<plugin::ParamSet> with_changes(std::span<const ParamSpec> specs,
                                      std::span<const ParamValue> present,
                                      std::span<const ParameterChange* const> changes) {
  std::vector<std::string_view> names;
  for (const ParamSpec& spec : specs) names.emplace_back(spec.name);
  for (const ParameterChange* const change : changes) {
    const auto spec = std::find(names.begin(), names.end(), change->name);
    if (spec == names.end()) {
      return fail(ErrorCode::kNotFound, "there is no parameter `{}`{}", change->name,
                  suggestion(change->name, names));
    }
    // All are checked before a set is made, so that an error changes nothing.
    RAVE_TRY(check_value(specs[static_cast<std::size_t>(spec - names.begin())], change->value));
  }
  plugin::ParamSet set;
  // A plug-in always gets all its parameters: the present ones with the changes in place.
  for (const ParamSpec& spec : specs) {
    const ParameterChange* changed = nullptr;
    for (const ParameterChange* const change : changes) {
      if (change->name == spec.name) changed = change;
    }
    const ParamValue* const value = find(present, spec.name);
    if (changed != nullptr) {
      add(set, spec, changed->value);
    } else if (value != nullptr) {
      add(set, spec, value_of(spec, *value));
    }
  }
  return set;
}

std::string value_text(const ParamSpec& spec, const ParamValue& value) {
  if (spec.type == ParamType::kBool) return value.number != 0 ? "true" : "false";
  return to_string(value_of(spec, value));
}

}  // namespace rave::sim
