// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_info.hpp"
#include "rave/robot_host/verify.hpp"

namespace rave::robot_host {

/// How the exact streams of two records compare.
struct RecordMatch {
  std::uint64_t messages = 0;  ///< That were compared.
  std::optional<RunDifference> difference;
};

/// Compares the exact streams that both records have, up to the first difference. `cut`: the first
/// one broke off, so that the second may go on where it ends. `run` and the device names come from
/// the first. Errors: those of MessageCursor::next().
[[nodiscard]] Result<RecordMatch> match_records(const record::McapReader& recorded,
                                                const record::McapReader& again,
                                                const record::RunInfo& run, bool cut);

}  // namespace rave::robot_host
