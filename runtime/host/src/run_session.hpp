// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rave/host/input_forwarder.hpp"
#include "rave/host/observer_list.hpp"
#include "rave/pace/late_watch.hpp"
#include "rave/pace/stall_watch.hpp"
#include "rave/pace/wall_pace.hpp"
#include "rave/recording/console_tee.hpp"
#include "rave/results/facts.hpp"
#include "rave/sim/engine.hpp"
#include "world_exchange.hpp"

namespace rave::runtime {

/// How many steps the run has.
[[nodiscard]] std::uint64_t steps_of(const config::ScenarioFile& scenario);

/// A run in progress in this process, alone or as one of several hosts: what the loop needs, and
/// what it leaves. Others can control the run while it exists. Owns none of what it refers to.
/// Belongs to the thread of the run.
struct RunSession {
  using Clock = std::chrono::steady_clock;

  /// `clock`: of the wall; its pace is known. `in_real_time`: the world outside continues.
  RunSession(sim::Engine& of, ObserverList& all, WallPace& clock, const config::ScenarioFile& run,
             const RunOptions& how, ConsoleTee& log, bool in_real_time);
  RunSession(const RunSession&) = delete;
  RunSession& operator=(const RunSession&) = delete;
  ~RunSession() {
    if (options.control != nullptr) options.control->end();
  }

  sim::Engine& engine;
  ObserverList& observers;
  WallPace& pace;
  const config::ScenarioFile& file;
  const RunOptions& options;
  ConsoleTee& console;
  const bool live;
  const std::uint64_t steps;  ///< Of the run.
  /// Where another process numbers the inputs: set by the exchange, which owns it; else null.
  InputForwarder* forwarder = nullptr;
  const bool has_real;   ///< Its status changes without a request,
  const bool has_twins;  ///< and so does this one.
  LateWatch late;
  StallWatch watch;
  std::uint64_t first = 0;  ///< The step with which this process began.
  std::uint64_t step = 0;   ///< That comes next.
  double wall_s = 0;
  bool stopped = false;  ///< By a request here,
  bool ended = false;    ///< or by the environment manager.
  std::vector<sim::Event> events{};
  std::vector<std::string> losses{};    ///< Of programs and drivers, which are events, too.
  std::vector<std::string> problems{};  ///< What else is not as it should be.
  Clock::time_point next_progress{};
  Clock::time_point next_status{};

  [[nodiscard]] bool stopping() const {
    return options.control != nullptr && options.control->stopping();
  }
};

/// The loop of every run: arms robots if that was asked for, then does step after step, until there
/// is none any more. Errors: those of `exchange`.
Status go_through(RunSession& run, WorldExchange& exchange);

/// Does what was requested since the last step.
void serve_requests(RunSession& run);

/// Shows a held run to its observers. Drivers are watched by wall time, which continues while a run
/// is held: a driver that falls silent stops driving.
void look_on_while_held(RunSession& run);

/// A step is done: all look at it, it is recorded, its events are published, and those that
/// `beside` the engine has. `world_age`: of the world of others in which robots drive.
void look_back(RunSession& run, std::span<const sim::Event> beside = {}, Duration world_age = {});

/// The run is over: robots stop, the recording ends. Returns the results; `problems` has all.
[[nodiscard]] RunFacts end_run(RunSession& run);

}  // namespace rave::runtime
