// SPDX-License-Identifier: Apache-2.0
#include "short_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "rave/base/text_width.hpp"

namespace rave::watch {
namespace {

struct Unit {
  double seconds;
  std::string_view name;
};
constexpr std::array<Unit, 3> kUnits = {{{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}}};

/// The largest unit in which the time is at least 1.
Unit unit_of(double seconds) {
  for (const Unit& unit : kUnits) {
    if (std::fabs(seconds) >= unit.seconds) return unit;
  }
  return kUnits.back();
}

}  // namespace

std::string time_text(double seconds) {
  const Unit unit = unit_of(seconds);
  const double value = seconds / unit.seconds;
  // The limit is where rounding to one decimal gives 10.0: from there on no decimal is shown.
  const bool fine = std::fabs(value) < 9.95 && unit.name != "us";
  return fine ? fmt::format("{:.1f} {}", value, unit.name)
              : fmt::format("{:.0f} {}", value, unit.name);
}

std::string number_text(double value) {
  const double size = std::fabs(value);
  if (size < 9.995) return fmt::format("{:.2f}", value);
  return size < 99.95 ? fmt::format("{:.1f}", value) : fmt::format("{:.0f}", value);
}

std::string offset_text(double offset_s, double bound_s) {
  const Unit unit = unit_of(std::max(std::fabs(offset_s), bound_s));
  return fmt::format("{:+.2f}±{:.2f} {}", offset_s / unit.seconds, bound_s / unit.seconds,
                     unit.name);
}

std::string fitted(std::string_view text, std::size_t width) {
  return clip_to_columns(without_controls(text), width);
}

}  // namespace rave::watch
