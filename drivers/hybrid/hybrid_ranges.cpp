// SPDX-License-Identifier: Apache-2.0
#include "hybrid_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rave {
namespace {

constexpr float kNoReturn = std::numeric_limits<float>::infinity();
constexpr float kInvalid = std::numeric_limits<float>::quiet_NaN();

}  // namespace

Status HybridRanges::start(const HybridSetup& setup) {
  const SensorInfo& real = *setup.real;
  if (real.capacity != setup.imagined->capacity) {
    return fail(ErrorCode::kInvalidArgument, "the real half has {} rays, the virtual one {}",
                real.capacity, setup.imagined->capacity);
  }
  occlusion_ = setup.parameters().text("rule") == "occlusion";
  if (occlusion_ && !(real.range_max_m > real.range_min_m)) {
    return fail(ErrorCode::kInvalidArgument,
                "the rule `occlusion` needs the range limits of the real half, which says {} to {} "
                "m; expected the rule `nearest`",
                real.range_min_m, real.range_max_m);
  }
  range_min_m_ = static_cast<float>(real.range_min_m);
  range_max_m_ = static_cast<float>(real.range_max_m);
  const std::string_view too_near = setup.parameters().text("too_near");
  too_near_m_ = range_min_m_;
  if (too_near == "no_return") too_near_m_ = kNoReturn;
  if (too_near == "invalid") too_near_m_ = kInvalid;
  return {};
}

/// Comparisons with NaN are false, so NaN never wins; it remains only if the other half has no
/// return either.
float HybridRanges::nearest(float real_m, float virtual_m) const noexcept {
  if (std::isnan(real_m)) return virtual_m < kNoReturn ? virtual_m : real_m;
  return virtual_m < real_m ? virtual_m : real_m;
}

float HybridRanges::occluded(float real_m, float virtual_m) const noexcept {
  // A real body below the minimum range occludes all others.
  if (real_m < range_min_m_) return real_m;
  // The real sensor could not see a virtual NaN or a body beyond its range.
  if (!(virtual_m <= range_max_m_)) return real_m;
  if (virtual_m >= real_m) return real_m;
  return virtual_m < range_min_m_ ? too_near_m_ : virtual_m;
}

void HybridRanges::fuse(const FuseItem& item) const {
  const auto* const real = static_cast<const float*>(item.real_records);
  const auto* const imagined = static_cast<const float*>(item.imagined_records);
  auto* const result = static_cast<float*>(item.result_records);
  const std::uint32_t rays = item.real->count;
  // Drop-out of ranges is per ray; further rays of one half are ignored.
  const std::uint32_t both = std::min(rays, item.imagined->count);
  for (std::uint32_t i = 0; i < both; ++i) {
    result[i] = occlusion_ ? occluded(real[i], imagined[i]) : nearest(real[i], imagined[i]);
  }
  std::copy(real + both, real + rays, result + both);
  item.result->count = rays;
}

}  // namespace rave
