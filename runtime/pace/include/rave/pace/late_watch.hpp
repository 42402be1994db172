// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/time.hpp"
#include "rave/control/run_control.hpp"
#include "rave/pace/lateness.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/sim/event.hpp"

namespace rave::runtime {

/// Counts missed deadlines of a run. Logs the beginning and end of lateness and shows it in the
/// status. Belongs to the thread of the run.
class LateWatch {
 public:
  using Clock = Lateness::Clock;

  /// `period`: as in Lateness. `control` may be null. Neither it nor `log` is owned.
  LateWatch(Clock::duration period, LogSink& log, RunControl* control);

  /// The counter, to which the loop reports its activities.
  [[nodiscard]] Lateness& count() noexcept { return lateness_; }
  /// How old the time of the current step is.
  [[nodiscard]] Duration age() const noexcept;
  /// Counts real robots that stop because their world is too old. `world_age`: the part of that age
  /// that other processes caused.
  void look(const sim::EngineSpec& spec, std::span<const sim::Event> events, Duration world_age);
  /// Call it after each step.
  void step_done();
  /// Call it at the end of the loop; `last`: due time of the last step. Logs the missed deadlines.
  void end(Clock::time_point last);

  /// Whether the last step was late; work for display only can then wait.
  [[nodiscard]] bool behind() const noexcept { return behind_; }
  [[nodiscard]] const LatenessFacts& facts() const noexcept { return lateness_.facts(); }
  /// The counts for the status of the run; empty without a pace.
  [[nodiscard]] std::optional<RunStatus::Lateness> status() const;

 private:
  void tell_change(Clock::duration late);

  Clock::duration period_;
  LogSink& log_;
  RunControl* control_;
  Lateness lateness_;
  bool behind_ = false;
  bool told_ = false;  ///< Whether lateness has been logged.
  Clock::duration last_{};
  Clock::time_point next_status_{};
};

/// Why a run by the wall clock is not complete: it missed more than `most_pct` percent of its
/// deadlines, or real robots were stopped. Empty: neither.
[[nodiscard]] std::vector<std::string> lateness_problems(const LatenessFacts& facts,
                                                         double most_pct);

}  // namespace rave::runtime
