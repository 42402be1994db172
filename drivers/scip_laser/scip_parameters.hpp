// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::scip {

/// The properties of a device from its reply to PP.
struct Parameters {
  std::string model;                ///< MODL
  std::int32_t range_min_mm = 0;    ///< DMIN
  std::int32_t range_max_mm = 0;    ///< DMAX
  std::int32_t steps_per_turn = 0;  ///< ARES
  std::int32_t first_step = 0;      ///< AMIN
  std::int32_t last_step = 0;       ///< AMAX
  std::int32_t front_step = 0;      ///< AFRT: the step straight ahead
  std::int32_t rpm = 0;             ///< SCAN: turns of the motor per minute

  friend bool operator==(const Parameters&, const Parameters&) = default;

  [[nodiscard]] double scan_period_s() const noexcept { return 60.0 / rpm; }
  /// Direction of a step, counter-clockwise from straight ahead, in (-pi, pi].
  [[nodiscard]] double bearing_rad(std::int32_t step) const noexcept;
};

/// Parses the lines of a reply to PP, `DMIN:20` and so on. Other keys are ignored. Errors (kParse):
/// a key is missing or duplicated; a value is not a number or implausible.
[[nodiscard]] Result<Parameters> parse_parameters(std::span<const std::string_view> lines);

/// The value of a key in a reply to VV or II; empty if it is missing.
[[nodiscard]] std::string_view value_of(std::span<const std::string_view> lines,
                                        std::string_view key) noexcept;

}  // namespace rave::scip
