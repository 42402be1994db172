// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/experiment/ledger.hpp"
#include "rave/experiment/plan.hpp"

namespace rave::experiment {

/// The finished runs of a plan as CSV (RFC 4180, lines end in `\n`), in the order of Plan::runs():
/// condition (from 1), factors, seed, failure, metrics, simulated time, run hash, and the command
/// that repeats the run. A time to an event has two columns, `NAME` and `NAME_seen`: the time of
/// the event and 1, or the end of the run and 0. Unknown values are empty.
[[nodiscard]] std::string run_table(const Plan& plan, const RunRows& rows);

}  // namespace rave::experiment
