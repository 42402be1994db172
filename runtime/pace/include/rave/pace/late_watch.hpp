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

/// Keeps count of how late the steps of a run come, tells the log when that begins and ends, and
/// whoever looks on. Belongs to the thread of the run.
class LateWatch {
 public:
  using Clock = Lateness::Clock;

  /// `period`: as of Lateness. `control` may be null; neither is owned.
  LateWatch(Clock::duration period, LogSink& log, RunControl* control);

  /// To be told what the loop does.
  [[nodiscard]] Lateness& count() noexcept { return lateness_; }
  /// How old the moment is that the step under way is for.
  [[nodiscard]] Duration age() const noexcept;
  /// What happened in a step: counts real robots that stand since the world that they drive in is
  /// too old. `world_age`: how much of that others are to blame for.
  void look(const sim::EngineSpec& spec, std::span<const sim::Event> events, Duration world_age);
  /// A step is done.
  void step_done();
  /// The loop ends; `last`: when its last step is due. The log is told what was missed.
  void end(Clock::time_point last);

  /// The last step was late: what only serves to look at can wait.
  [[nodiscard]] bool behind() const noexcept { return behind_; }
  [[nodiscard]] const LatenessFacts& facts() const noexcept { return lateness_.facts(); }
  /// The same for those who look on; none without a pace.
  [[nodiscard]] std::optional<RunStatus::Lateness> status() const;

 private:
  void tell_change(Clock::duration late);

  Clock::duration period_;
  LogSink& log_;
  RunControl* control_;
  Lateness lateness_;
  bool behind_ = false;
  bool told_ = false;  ///< The log knows that steps come late.
  Clock::duration last_{};
  Clock::time_point next_status_{};
};

/// Why a run by the wall clock is not whole: it missed a larger share of its deadlines than
/// `most_pct`, or real robots were stopped. Empty: neither.
[[nodiscard]] std::vector<std::string> lateness_problems(const LatenessFacts& facts,
                                                         double most_pct);

}  // namespace rave::runtime
