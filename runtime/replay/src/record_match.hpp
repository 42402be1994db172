// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_info.hpp"
#include "rave/replay/verify.hpp"

namespace rave::runtime {

/// How the exact streams of two records compare.
struct RecordMatch {
  std::uint64_t messages = 0;  ///< That were compared.
  std::optional<RunDifference> difference;
  std::vector<std::string> absent;  ///< Streams that the first does not have; not compared.
};

/// What is to be known of the first of two records.
struct RecordForm {
  bool cut = false;     ///< It broke off, so the second may go on where it ends.
  bool merged = false;  ///< It was made of several: in a step robots come in any order.
};

/// Compares the exact streams that the first record has, up to the first difference. `run` and the
/// device names come from the first. Errors: those of MessageCursor::next().
[[nodiscard]] Result<RecordMatch> match_records(const record::McapReader& recorded,
                                                const record::McapReader& again,
                                                const record::RunInfo& run, RecordForm form);

}  // namespace rave::runtime
