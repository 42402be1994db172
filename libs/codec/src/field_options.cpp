// SPDX-License-Identifier: Apache-2.0
// Limits and units of fields, as words for errors and documentation.
#include "rave/codec/field_options.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "rave/codec/numbers.hpp"

namespace rave::codec {
namespace {

constexpr std::array<std::pair<std::string_view, std::string_view>, 22> kUnits = {{
    {"m", "metres"},
    {"s", "seconds"},
    {"ms", "milliseconds"},
    {"kg", "kilograms"},
    {"rad", "radians"},
    {"deg", "degrees"},
    {"Hz", "hertz"},
    {"m/s", "metres per second"},
    {"m/s^2", "metres per second squared"},
    {"m/s2", "metres per second squared"},
    {"rad/s", "radians per second"},
    {"rad/s^2", "radians per second squared"},
    {"rad/s2", "radians per second squared"},
    {"deg/s", "degrees per second"},
    {"N", "newtons"},
    {"N m", "newton metres"},
    {"kg m^2", "kilogram square metres"},
    {"V", "volts"},
    {"dBm", "decibel milliwatts"},
    {"dB", "decibels"},
    {"px", "pixels"},
    {"%", "per cent"},
}};

// Limits in words, as part of a sentence of an error.
std::string range_words(const FieldOptions& o) {
  if (o.min && o.max && !o.exclusive_min && !o.exclusive_max) {
    return fmt::format("from {} to {}", number_text(*o.min), number_text(*o.max));
  }
  std::string words;
  if (o.min) {
    words =
        fmt::format("{} {}", o.exclusive_min ? "greater than" : "at least", number_text(*o.min));
  }
  if (o.max) {
    words += fmt::format("{}{} {}", words.empty() ? "" : " and ",
                         o.exclusive_max ? "less than" : "at most", number_text(*o.max));
  }
  return words;
}

}  // namespace

std::string_view unit_words(std::string_view unit) noexcept {
  for (const auto& [symbol, words] : kUnits) {
    if (symbol == unit) return words;
  }
  return unit;
}

std::string number_expectation(std::string_view noun, const FieldOptions& options) {
  std::string inner = range_words(options);
  if (!options.unit.empty()) {
    inner += fmt::format("{}in {}", inner.empty() ? "" : ", ", unit_words(options.unit));
  }
  return inner.empty() ? std::string(noun) : fmt::format("{} ({})", noun, inner);
}

bool in_range(double value, const FieldOptions& options) noexcept {
  // NaN fails these conditions, so it is in no range.
  if (options.min && !(options.exclusive_min ? value > *options.min : value >= *options.min)) {
    return false;
  }
  return !options.max || (options.exclusive_max ? value < *options.max : value <= *options.max);
}

std::string plural(std::string_view noun, std::size_t count) {
  if (count == 1) return std::string(noun);
  return noun.ends_with('y') ? fmt::format("{}ies", noun.substr(0, noun.size() - 1))
                             : fmt::format("{}s", noun);
}

std::string length_expectation(const FieldOptions& options, std::string_view item) {
  const auto& low = options.min_items;
  const auto& high = options.max_items;
  if (low && high && *low == *high) return fmt::format(" of {} {}", *low, plural(item, *low));
  if (low && high) return fmt::format(" of {} to {} {}", *low, *high, plural(item, *high));
  if (low) return fmt::format(" of at least {} {}", *low, plural(item, *low));
  if (high) return fmt::format(" of at most {} {}", *high, plural(item, *high));
  return {};
}

bool in_length(std::size_t size, const FieldOptions& options) noexcept {
  return size >= options.min_items.value_or(0) &&
         (!options.max_items || size <= *options.max_items);
}

}  // namespace rave::codec
