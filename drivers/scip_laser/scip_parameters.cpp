// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/scip_parameters.hpp"

#include <algorithm>
#include <charconv>

#include "rave/math/scalar.hpp"

namespace rave::scip {
namespace {

constexpr std::int32_t kLongest_mm = 262'143;  // 18 bits
constexpr std::int32_t kMostSteps = 9'999;     // four decimal digits in a command
constexpr std::int32_t kFastest_rpm = 60'000;

Result<std::int32_t> number_of(std::span<const std::string_view> lines, std::string_view key,
                               std::int32_t least, std::int32_t most) {
  std::string_view text = value_of(lines, key);
  if (text.empty()) return fail(ErrorCode::kParse, "the reply to PP has no `{}`", key);
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  std::int32_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end || value < least || value > most) {
    return fail(ErrorCode::kParse, "the reply to PP has `{}:{}`; expected {} to {}", key, text,
                least, most);
  }
  return value;
}

}  // namespace

double Parameters::bearing_rad(std::int32_t step) const noexcept {
  return wrap_angle(static_cast<double>(step - front_step) * (2 * kPi / steps_per_turn));
}

std::string_view value_of(std::span<const std::string_view> lines, std::string_view key) noexcept {
  for (const std::string_view line : lines) {
    if (line.starts_with(key) && line.size() > key.size() && line[key.size()] == ':') {
      return line.substr(key.size() + 1);
    }
  }
  return {};
}

Result<Parameters> parse_parameters(std::span<const std::string_view> lines) {
  // A duplicate key may come from two replies that were mixed up.
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view key = lines[i].substr(0, lines[i].find(':'));
    for (std::size_t k = 0; k < i; ++k) {
      if (lines[k].substr(0, lines[k].find(':')) != key) continue;
      return fail(ErrorCode::kParse, "the reply to PP has `{}` twice", key);
    }
  }
  Parameters p;
  p.model = value_of(lines, "MODL");
  RAVE_TRY_ASSIGN(p.range_min_mm, number_of(lines, "DMIN", 0, kLongest_mm));
  RAVE_TRY_ASSIGN(p.range_max_mm, number_of(lines, "DMAX", p.range_min_mm, kLongest_mm));
  RAVE_TRY_ASSIGN(p.steps_per_turn, number_of(lines, "ARES", 1, kMostSteps));
  const std::int32_t most = std::min(kMostSteps, p.steps_per_turn);
  RAVE_TRY_ASSIGN(p.first_step, number_of(lines, "AMIN", 0, most));
  RAVE_TRY_ASSIGN(p.last_step, number_of(lines, "AMAX", p.first_step, most));
  RAVE_TRY_ASSIGN(p.front_step, number_of(lines, "AFRT", 0, most));
  RAVE_TRY_ASSIGN(p.rpm, number_of(lines, "SCAN", 1, kFastest_rpm));
  return p;
}

}  // namespace rave::scip
