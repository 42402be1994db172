// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace rave {

/// The type of a parameter. The numbers are part of the plug-in interface.
enum class ParamType : std::uint32_t { kBool, kInteger, kNumber, kText, kChoice, kNumbers };

/// The declaration of one parameter of a driver or program. All pointers refer to constants that
/// live as long as the plug-in. Make specs with the functions below.
struct ParamSpec {
  const char* name = "";  ///< Includes the unit: `range_m`, `period_s`, `fov_deg`.
  ParamType type = ParamType::kNumber;
  std::uint32_t required = 0;     ///< 1: the file must contain it.
  const char* unit = "";          ///< As shown to people: `m`, `rad/s`; empty for a pure number.
  double min = 0;                 ///< Smallest value of an integer, number or list element.
  double max = 0;                 ///< Largest value.
  double default_number = 0;      ///< Default of bool (0 or 1), integer and number.
  const char* default_text = "";  ///< Default of text and choice.
  const char* const* choices = nullptr;  ///< Permitted values of a choice.
  std::uint64_t choice_count = 0;
  const char* doc = "";  ///< One sentence.
};

/// A number in `unit` from `min` to `max`; `value` is the default.
constexpr ParamSpec number_param(const char* name, const char* unit, double value, double min,
                                 double max, const char* doc) noexcept {
  ParamSpec spec;
  spec.name = name;
  spec.unit = unit;
  spec.default_number = value;
  spec.min = min;
  spec.max = max;
  spec.doc = doc;
  return spec;
}

/// An integer from `min` to `max`; `value` is the default.
constexpr ParamSpec integer_param(const char* name, std::int64_t value, std::int64_t min,
                                  std::int64_t max, const char* doc) noexcept {
  ParamSpec spec = number_param(name, "", static_cast<double>(value), static_cast<double>(min),
                                static_cast<double>(max), doc);
  spec.type = ParamType::kInteger;
  return spec;
}

/// A Boolean; `value` is the default.
constexpr ParamSpec bool_param(const char* name, bool value, const char* doc) noexcept {
  ParamSpec spec = number_param(name, "", value ? 1 : 0, 0, 1, doc);
  spec.type = ParamType::kBool;
  return spec;
}

/// A text; `value` is the default.
constexpr ParamSpec text_param(const char* name, const char* value, const char* doc) noexcept {
  ParamSpec spec;
  spec.name = name;
  spec.type = ParamType::kText;
  spec.default_text = value;
  spec.doc = doc;
  return spec;
}

/// One of `choices`, which must live as long as the plug-in; `value` is the default.
constexpr ParamSpec choice_param(const char* name, const char* value,
                                 std::span<const char* const> choices, const char* doc) noexcept {
  ParamSpec spec = text_param(name, value, doc);
  spec.type = ParamType::kChoice;
  spec.choices = choices.data();
  spec.choice_count = choices.size();
  return spec;
}

/// A list of numbers, empty by default.
constexpr ParamSpec numbers_param(const char* name, const char* unit, double min, double max,
                                  const char* doc) noexcept {
  ParamSpec spec = number_param(name, unit, 0, min, max, doc);
  spec.type = ParamType::kNumbers;
  return spec;
}

/// A copy of `spec` without a default: the file must contain the parameter.
constexpr ParamSpec required(ParamSpec spec) noexcept {
  spec.required = 1;
  return spec;
}

/// The value of one parameter, checked against its spec by the host. The type of the spec
/// determines which member is set.
struct ParamValue {
  const char* name = "";
  double number = 0;  ///< Bool, integer (exact up to 2^53) and number.
  const char* text = "";
  const double* list = nullptr;
  std::uint64_t list_size = 0;
};

/// All parameters of one driver or program, in the order of its specs, with defaults filled in. A
/// view, valid during the call that receives it.
class Params {
 public:
  constexpr Params() noexcept = default;
  constexpr explicit Params(std::span<const ParamValue> values) noexcept
      : values_(values.data()), count_(values.size()) {}

  /// The value of the declared parameter `name`. Throws std::invalid_argument for an undeclared
  /// name: a mistake in the source of the driver, which the host reports with its name.
  [[nodiscard]] constexpr double number(std::string_view name) const { return find(name).number; }
  [[nodiscard]] constexpr std::int64_t integer(std::string_view name) const {
    return static_cast<std::int64_t>(find(name).number);
  }
  [[nodiscard]] constexpr bool flag(std::string_view name) const { return find(name).number != 0; }
  [[nodiscard]] constexpr std::string_view text(std::string_view name) const {
    return find(name).text;
  }
  [[nodiscard]] constexpr std::span<const double> numbers(std::string_view name) const {
    const ParamValue& value = find(name);
    return {value.list, value.list_size};
  }
  [[nodiscard]] constexpr std::span<const ParamValue> values() const noexcept {
    return {values_, count_};
  }

 private:
  [[nodiscard]] constexpr const ParamValue& find(std::string_view name) const {
    for (const ParamValue& value : values()) {
      if (name == value.name) return value;
    }
    throw std::invalid_argument("the source asks for the parameter `" + std::string(name) +
                                "`, which is not declared");
  }

  const ParamValue* values_ = nullptr;
  std::uint64_t count_ = 0;
};

}  // namespace rave
