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

/// The result of comparing the exact streams of two recordings.
struct RecordMatch {
  std::uint64_t messages = 0;  ///< The number of compared messages.
  std::optional<RunDifference> difference;
  std::vector<std::string> absent;  ///< Streams missing in the first recording; not compared.
};

/// Properties of the first of two recordings.
struct RecordForm {
  bool cut = false;  ///< It was interrupted, so the second one may continue after its end.
  /// It was merged from several, so the order of robots within a step is arbitrary.
  bool merged = false;
};

/// Compares the exact streams of the first recording, up to the first difference. `run` and the
/// device names come from the first one. Errors: those of MessageCursor::next().
[[nodiscard]] Result<RecordMatch> match_records(const record::McapReader& recorded,
                                                const record::McapReader& again,
                                                const record::RunInfo& run, RecordForm form);

}  // namespace rave::runtime
