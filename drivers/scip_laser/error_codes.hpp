// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

namespace rave::scip {

/// What a number below kLeastRange_mm means instead of a range. Source: Hokuyo, "Communication
/// Protocol Specification For SCIP2.0 Standard", C-42-03320B, tables 3 and 4.
enum class ErrorCodes : std::uint8_t {
  kReasons,   ///< Why a step could not be measured: URG-04LX and its kin. None says "free".
  kDistances  ///< 1: nothing in reach, 2: too near, the rest: not measured. UTM-30LX and later.
};

/// No SCIP laser measures less; what is below is a code.
inline constexpr std::int32_t kLeastRange_mm = 20;

/// By the model that the device states (MODL).
[[nodiscard]] ErrorCodes error_codes_of(std::string_view model) noexcept;
/// The range that a code stands for: +infinity, `range_min_m`, or NaN if nothing is known.
[[nodiscard]] float range_of_code(std::int32_t code, ErrorCodes codes, float range_min_m) noexcept;

}  // namespace rave::scip
