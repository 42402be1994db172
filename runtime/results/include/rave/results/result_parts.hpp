// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "rave/results/facts.hpp"
#include "rave/sim/engine.hpp"

// Parts of result.json that single hosts write as well, and what the summary says of them.
namespace rave::runtime {

/// `lateness`: null for a run without deadlines.
[[nodiscard]] nlohmann::ordered_json lateness_json(const LatenessFacts& facts);

/// `shadows`. Reports that are not JSON objects are omitted, because they may come from other
/// hosts.
[[nodiscard]] nlohmann::ordered_json shadows_json(const std::vector<ShadowFacts>& shadows);

/// Whether any robot of the run has a communicator.
[[nodiscard]] bool has_radio(const sim::EngineSpec& spec);
/// Adds `radio`, the counts of all messages and the reports of transmitters, if there is a radio.
void add_radio(const sim::EngineSpec& spec, const RunFacts& facts, nlohmann::ordered_json& json);
/// A line about messages for the summary.
[[nodiscard]] std::string radio_line(const sim::RadioCounts& counts);

}  // namespace rave::runtime
