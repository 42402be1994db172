// SPDX-License-Identifier: Apache-2.0
#include "step_rate.hpp"

#include <algorithm>

namespace rave::manager {

void StepRate::note(std::uint64_t step, std::int64_t now_ns) noexcept {
  if (!step_ || step < *step_) {
    *this = {};
    step_ = step;
    since_ns_ = now_ns;
    return;
  }
  // States arrive in bursts, so a rate over single intervals would jump.
  if (now_ns - since_ns_ < kWindow_ns) return;
  lasted_ns_ = now_ns - since_ns_;
  rate_ = static_cast<double>(step - *step_) * 1e9 / static_cast<double>(lasted_ns_);
  step_ = step;
  since_ns_ = now_ns;
}

std::optional<double> StepRate::at(std::int64_t now_ns) const noexcept {
  if (!rate_) return std::nullopt;
  // A host that falls silent does not keep its last rate. After twice the last interval the rate
  // decreases as one over the time of silence.
  const std::int64_t patience_ns = 2 * lasted_ns_;
  const std::int64_t silent_ns = std::max(patience_ns, now_ns - since_ns_);
  return *rate_ * static_cast<double>(patience_ns) / static_cast<double>(silent_ns);
}

}  // namespace rave::manager
