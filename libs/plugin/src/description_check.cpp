// SPDX-License-Identifier: Apache-2.0
// What a plug-in says of itself must be complete, because users see nothing else of it.
#include "description_check.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace rave::plugin {
namespace {

bool empty(const char* text) noexcept { return text == nullptr || *text == '\0'; }

bool is_snake_case(std::string_view name) noexcept {
  const auto inner = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  return !name.empty() && name.front() >= 'a' && name.front() <= 'z' &&
         std::all_of(name.begin(), name.end(), inner);
}

/// The problem with the choices of `spec`; empty if there is none.
std::string choices_problem(const ParamSpec& spec) {
  if (spec.choices == nullptr || spec.choice_count == 0) return "it has no choices";
  const std::span choices(spec.choices, spec.choice_count);
  if (std::any_of(choices.begin(), choices.end(), empty)) return "one of its choices is empty";
  const std::string_view value = spec.default_text;
  if (spec.required == 0 && std::none_of(choices.begin(), choices.end(),
                                         [&](const char* choice) { return value == choice; })) {
    return fmt::format("its default `{}` is not one of its choices", value);
  }
  return {};
}

/// The problem with the range or default of a number, integer, bool or list.
std::string range_problem(const ParamSpec& spec) {
  // NaN fails this condition.
  if (!(spec.min <= spec.max)) {
    return fmt::format("its range is reversed (min {}, max {})", spec.min, spec.max);
  }
  if (spec.type == ParamType::kNumbers || spec.required != 0) return {};
  const double value = spec.default_number;
  if (!(value >= spec.min && value <= spec.max)) {
    return fmt::format("its default {} is outside {} to {}", value, spec.min, spec.max);
  }
  if (spec.type != ParamType::kNumber && std::floor(value) != value) {
    return fmt::format("its default {} is not a whole number", value);
  }
  return {};
}

std::string param_problem(const ParamSpec& spec) {
  if (spec.unit == nullptr || spec.default_text == nullptr) return "one of its texts is null";
  if (empty(spec.doc)) return "it has no explanation";
  switch (spec.type) {
    case ParamType::kText:
      return {};
    case ParamType::kChoice:
      return choices_problem(spec);
    case ParamType::kBool:
    case ParamType::kInteger:
    case ParamType::kNumber:
    case ParamType::kNumbers:
      return range_problem(spec);
  }
  return fmt::format("its type {} is unknown", static_cast<std::uint32_t>(spec.type));
}

Status check_params(const DriverInfo& info) {
  if (info.param_count > 0 && info.params == nullptr) {
    return fail(ErrorCode::kPlugin, "driver `{}` declares {} parameters but has none", info.name,
                info.param_count);
  }
  std::set<std::string_view> names;
  for (const ParamSpec& spec : info.param_specs()) {
    if (empty(spec.name) || !is_snake_case(spec.name)) {
      return fail(ErrorCode::kPlugin,
                  "a parameter of driver `{}` is called `{}`: names are lower_snake_case",
                  info.name, empty(spec.name) ? "" : spec.name);
    }
    if (!names.insert(spec.name).second) {
      return fail(ErrorCode::kPlugin, "driver `{}` has parameter `{}` twice", info.name, spec.name);
    }
    if (const std::string problem = param_problem(spec); !problem.empty()) {
      return fail(ErrorCode::kPlugin, "parameter `{}` of driver `{}`: {}", spec.name, info.name,
                  problem);
    }
  }
  return {};
}

}  // namespace

Status check_description(const DriverInfo& info, const void* ops) {
  if (empty(info.name)) return fail(ErrorCode::kPlugin, "registers a driver with an empty name");
  if (!is_snake_case(info.name)) {
    return fail(ErrorCode::kPlugin, "driver name `{}` is not lower_snake_case", info.name);
  }
  // Numbers come from foreign code, so an enum may have a value that it does not name.
  if (static_cast<std::uint32_t>(info.kind) >= kDriverKindCount) {
    return fail(ErrorCode::kPlugin, "driver `{}` has the unknown kind {}", info.name,
                static_cast<std::uint32_t>(info.kind));
  }
  if (info.clock > DriverClock::kEither) {
    return fail(ErrorCode::kPlugin, "driver `{}` has the unknown clock {}", info.name,
                static_cast<std::uint32_t>(info.clock));
  }
  if (info.timing > SampleTiming::kEvents) {
    return fail(ErrorCode::kPlugin, "driver `{}` has the unknown timing {}", info.name,
                static_cast<std::uint32_t>(info.timing));
  }
  if (info.timing != SampleTiming::kUnknown && info.kind != DriverKind::kSensor) {
    return fail(ErrorCode::kPlugin, "driver `{}` declares a sample timing, but is a {}", info.name,
                rave::to_string(info.kind));
  }
  if (info.device == nullptr) {
    return fail(ErrorCode::kPlugin,
                "driver `{}` has null as device; expected an empty string for none", info.name);
  }
  if (empty(info.version)) {
    return fail(ErrorCode::kPlugin, "driver `{}` has no version", info.name);
  }
  if (empty(info.summary)) {
    return fail(ErrorCode::kPlugin, "driver `{}` has no summary", info.name);
  }
  if (ops == nullptr) {
    return fail(ErrorCode::kPlugin, "driver `{}` has no function table (null ops)", info.name);
  }
  return check_params(info);
}

}  // namespace rave::plugin
