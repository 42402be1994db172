// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace rave::gui_server {

/// When the next frame of a page is due. States of a run and frames of a page have rates of their
/// own, so a frame goes with a fresh state: a little before its turn if a state comes then, and a
/// little later if one is about to come. At a fixed beat a frame would carry a state that is up to
/// one interval of states old. On average the asked rate is kept. One thread.
class FramePace {
 public:
  using Clock = std::chrono::steady_clock;

  /// Frames per second that the page asks for, above 0.
  void set_rate(double hz) {
    period_ = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / hz));
  }
  /// Whether a frame with this picture is due, if there is something to send; asked some 25 to 60
  /// times a second.
  [[nodiscard]] bool due(Clock::time_point now, std::uint64_t picture) {
    const bool fresh = picture != seen_;
    if (fresh) note(now, picture);
    return now >= (fresh ? due_ - slack() : due_ + slack());
  }
  /// A frame goes out at `now`, due or not.
  void went(Clock::time_point now) {
    const bool in_turn = now >= due_ - slack() && now < due_ + period_;
    due_ = in_turn ? due_ + period_ : now + period_;
  }

 private:
  /// Half of the time between two states: nearer to its turn than that is no other.
  [[nodiscard]] Clock::duration slack() const { return std::min(between_, period_) / 2; }
  void note(Clock::time_point now, std::uint64_t picture) {
    if (seen_ != 0) {
      const auto gap = std::min<Clock::duration>(now - seen_at_, kLongest);
      between_ = between_ == Clock::duration() ? gap : between_ + (gap - between_) / 8;
    }
    seen_ = picture;
    seen_at_ = now;
  }

  static constexpr std::chrono::milliseconds kLongest{100};
  std::uint64_t seen_ = 0;  ///< The newest picture, and when it was there.
  Clock::time_point seen_at_{};
  Clock::duration between_{};  ///< Between two pictures, on average.
  Clock::duration period_ = std::chrono::milliseconds(33);
  Clock::time_point due_{};
};

}  // namespace rave::gui_server
