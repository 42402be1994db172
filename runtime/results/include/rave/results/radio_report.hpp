// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "rave/results/facts.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

/// Whether any robot of the run has a communicator.
[[nodiscard]] bool has_radio(const sim::EngineSpec& spec);

/// `radio` of result.json: counts of all messages.
[[nodiscard]] nlohmann::ordered_json radio_json(const sim::RadioCounts& counts);

/// `transmitters` of result.json: the reports of the drivers.
[[nodiscard]] nlohmann::ordered_json transmitters_json(
    const sim::EngineSpec& spec, const std::vector<InstrumentFacts>& transmitters);

/// A line about messages for the summary.
[[nodiscard]] std::string radio_line(const sim::RadioCounts& counts);

}  // namespace rave::runtime
