// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <thread>

#include "rave/control/run_control.hpp"
#include "rave/robot/sample_queue.hpp"

namespace rave::runtime {

/// Time between two progress messages.
inline constexpr auto kProgressInterval = std::chrono::milliseconds(100);

/// The clock of PhaseTimes, so that the phases of late steps can be measured.
inline std::int64_t steady_ns() noexcept {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// Converts between simulation time and wall time. Written by one thread before the run starts,
/// read by any afterwards.
class WallPace final : public RunClock {
 public:
  using Clock = std::chrono::steady_clock;

  /// `factor`: simulated seconds per second; 0: no limit.
  explicit WallPace(double factor) : factor_(factor) {}

  void set_factor(double factor) noexcept { factor_ = factor; }
  /// Changes the factor of a run in progress, whose time is `now`.
  void change_factor(double factor, SimTime now) noexcept {
    factor_ = factor;
    begin_.store(Clock::now());
    begin_.store(begin_.load() - (wall_time_of(now) - begin_.load()));
  }
  void start() noexcept { begin_.store(Clock::now()); }
  /// Sets the wall time of simulation time 0, in the past or future.
  void start_at(Clock::time_point begin) noexcept { begin_.store(begin); }

  [[nodiscard]] SimTime now() const noexcept override {
    const auto elapsed = std::chrono::duration<double>(Clock::now() - begin_.load());
    return {static_cast<std::int64_t>(elapsed.count() * 1e9 * (factor_ == 0 ? 1 : factor_))};
  }

  [[nodiscard]] Clock::time_point wall_time_of(SimTime t) const noexcept override {
    const double factor = factor_ == 0 ? 1 : factor_;
    return begin_.load() +
           std::chrono::nanoseconds(static_cast<std::int64_t>(static_cast<double>(t.ns) / factor));
  }

  /// Wall time of one step; 0 without a pace.
  [[nodiscard]] Clock::duration period_of(Duration step) const noexcept {
    return factor_ == 0 ? Clock::duration() : wall_time_of({step.ns}) - wall_time_of({});
  }

  /// Excludes the duration of a pause of a stepped run.
  void shift(Clock::duration held) noexcept { begin_.store(begin_.load() + held); }

  /// Sleeps until `t` is due. Meanwhile checks for the end of the run and calls `look`. Returns at
  /// once without a pace.
  template <class Look>
  void wait_for(SimTime t, const RunControl* control, Look&& look) const {
    if (factor_ == 0) return;
    constexpr auto kLook = std::chrono::milliseconds(100);
    const auto due = wall_time_of(t);
    for (auto now = Clock::now(); now < due; now = Clock::now()) {
      if (control != nullptr && control->stopping()) return;
      std::this_thread::sleep_until(std::min(due, now + kLook));
      look();
    }
  }

 private:
  double factor_;
  std::atomic<Clock::time_point> begin_{Clock::now()};
};

}  // namespace rave::runtime
