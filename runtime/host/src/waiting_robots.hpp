// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/host/run.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

/// Arms robots if that was asked for, else says who waits for it.
void tell_who_waits(sim::Engine& engine, const RunOptions& options, LogSink& log);

}  // namespace rave::runtime
