// SPDX-License-Identifier: Apache-2.0
#include "rave/control/held_sticks.hpp"

#include <algorithm>
#include <utility>

#include "rave/control/drive_watch.hpp"

namespace rave::runtime {
namespace {

/// Pages that are gone never become neutral: the oldest gives way.
constexpr std::size_t kMost = 256;

}  // namespace

void HeldSticks::forget(const Stick& stick) {
  std::erase_if(held_, [&stick](const Held& held) { return held.stick == stick; });
}

void HeldSticks::keep(Held held) {
  forget(held.stick);
  if (held_.size() >= kMost) held_.erase(held_.begin());
  held_.push_back(std::move(held));
}

void HeldSticks::hold(Stick stick, std::string why, Time now) {
  keep({std::move(stick), std::move(why), now});
}

void HeldSticks::silent(Stick stick, Time now) {
  if (stick.page != 0) keep({std::move(stick), {}, now});
}

Result<HeldSticks::Use> HeldSticks::use(const Stick& stick, bool neutral, Time now) {
  const auto held = std::ranges::find(held_, stick, &Held::stick);
  if (held == held_.end()) return Use::kCounts;
  const bool was_silent = held->why.empty();
  const auto since = now - held->heard;
  const bool over = was_silent ? since <= kSlowLink : stick.page == 0 && since >= kForgotten;
  if (neutral || over) {
    held_.erase(held);
    return neutral && !was_silent ? Use::kFreed : Use::kCounts;
  }
  if (was_silent) {
    return fail(ErrorCode::kState,
                "the driver of {} was silent for {:.1f} s; let the stick go, then drive on",
                stick.robot, std::chrono::duration<double>(since + DriveWatch::kSilence).count());
  }
  held->heard = now;
  return fail(ErrorCode::kState, "{}; let the stick go before it drives {}", held->why,
              stick.robot);
}

}  // namespace rave::runtime
