// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/observe/kinds.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

/// Logs the events of the last step, except contacts, and appends them to `all`.
void tell_events(const sim::Engine& engine, std::span<const sim::Event> events, LogSink* log,
                 std::vector<sim::Event>& all);

/// All events of a run as text, one per line.
[[nodiscard]] std::string events_log(const sim::EngineSpec& spec, const BodyKinds& kinds,
                                     const std::vector<sim::Event>& events);

}  // namespace rave::runtime
