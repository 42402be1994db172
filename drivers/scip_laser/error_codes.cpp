// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/error_codes.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace rave::scip {
namespace {

// Codes of the later table. 4, "out of range at the near end", is not taken for a distance: it is
// also what a device says of light that it could not place.
constexpr std::int32_t kNothingInReach = 1;
constexpr std::int32_t kTooNear = 2;

}  // namespace

ErrorCodes error_codes_of(std::string_view model) noexcept {
  using namespace std::string_view_literals;
  constexpr std::array kWithReasons = {"URG-04LX"sv, "UBG-04LX"sv, "UBG-05LX"sv, "UHG-08LX"sv};
  const bool reasons =
      std::any_of(kWithReasons.begin(), kWithReasons.end(),
                  [&](std::string_view name) { return model.find(name) != model.npos; });
  return reasons ? ErrorCodes::kReasons : ErrorCodes::kDistances;
}

float range_of_code(std::int32_t code, ErrorCodes codes, float range_min_m) noexcept {
  if (codes == ErrorCodes::kDistances && code == kNothingInReach) {
    return std::numeric_limits<float>::infinity();
  }
  if (codes == ErrorCodes::kDistances && code == kTooNear) return range_min_m;
  return std::numeric_limits<float>::quiet_NaN();
}

}  // namespace rave::scip
