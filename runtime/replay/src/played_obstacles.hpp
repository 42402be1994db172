// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/result.hpp"
#include "rave/codec/raw_node.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_info.hpp"

namespace rave::replay {

/// The entries of `changes:` that do to the obstacles of a recorded world what was done to them in
/// the run, by its scenario or by hand; a sequence, empty if nothing was. `start_s` of the record
/// is time 0; what came before counts from there on. Errors: kIo, kParse.
[[nodiscard]] Result<codec::RawNode> played_obstacles(const record::McapReader& reader,
                                                      const record::RunInfo& run, double start_s);

}  // namespace rave::replay
