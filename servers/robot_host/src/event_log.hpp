// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "kinds.hpp"
#include "rave/base/log.hpp"
#include "rave/robot_host/run.hpp"
#include "rave/sim/engine.hpp"

namespace rave::robot_host {

/// Tells the log of events of the last step, contacts excepted, and adds them to `all`.
void tell_events(const sim::Engine& engine, std::span<const sim::Event> events, LogSink* log,
                 std::vector<sim::Event>& all);

/// All events of a run, one per line, for people.
[[nodiscard]] std::string events_log(const sim::EngineSpec& spec, const BodyKinds& kinds,
                                     const std::vector<sim::Event>& events);

/// Arms robots if that was asked for, else says who waits for it.
void tell_who_waits(sim::Engine& engine, const RunOptions& options, LogSink& log);

}  // namespace rave::robot_host
