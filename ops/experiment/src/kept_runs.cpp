// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/kept_runs.hpp"

#include <fmt/format.h>

#include <optional>
#include <system_error>

namespace rave::experiment {
namespace {

namespace fs = std::filesystem;
using config::KeepRecordings;

}  // namespace

fs::path kept_run(const PlannedRun& run) {
  return fs::path("runs") / fmt::format("c{}-s{}", run.condition + 1, run.seed);
}

bool KeptRuns::record() const { return plan_.experiment.recordings != KeepRecordings::kNone; }

/// Whether no other finished run of the condition has a smaller value of the first metric, or none
/// a larger one; of equal values the smallest seed counts. A censored time is the largest.
bool KeptRuns::is_extreme(const PlannedRun& run, const RunRows& rows) const {
  const std::string& inputs = plan_.conditions[run.condition].inputs;
  const RunRow* const own = rows.find(inputs, run.seed);
  if (own == nullptr || own->values.empty()) return false;
  const auto key = [](const RunRow& row) { return row.values[0].value_or(1e300); };
  bool least = true;
  bool most = true;
  for (int r = 0; r < plan_.experiment.repetitions; ++r) {
    const std::uint64_t seed = plan_.experiment.first_seed + static_cast<std::uint64_t>(r);
    const RunRow* const other = rows.find(inputs, seed);
    if (other == nullptr || other == own || other->values.empty()) continue;
    const bool first = seed < run.seed;
    if (key(*other) < key(*own) || (key(*other) == key(*own) && first)) least = false;
    if (key(*other) > key(*own) || (key(*other) == key(*own) && first)) most = false;
  }
  return least || most;
}

void KeptRuns::remove_others(std::size_t condition, const RunRows& rows) const {
  for (int r = 0; r < plan_.experiment.repetitions; ++r) {
    const PlannedRun run{condition, plan_.experiment.first_seed + static_cast<std::uint64_t>(r)};
    const RunRow* const row = rows.find(plan_.conditions[condition].inputs, run.seed);
    if (row == nullptr || !row->failure.empty() || is_extreme(run, rows)) continue;
    std::error_code ignored;  // what stays is larger than it must be, and nothing else
    fs::remove_all(folder_ / kept_run(run), ignored);
  }
}

Status KeptRuns::settle(const PlannedRun& run, const fs::path& results, const RunRows& rows) {
  const RunRow* const row = rows.find(plan_.conditions[run.condition].inputs, run.seed);
  const bool failed = row != nullptr && !row->failure.empty();
  const KeepRecordings rule = plan_.experiment.recordings;
  const bool keep = rule == KeepRecordings::kAll || (rule != KeepRecordings::kNone && failed) ||
                    (rule == KeepRecordings::kExtremes && is_extreme(run, rows));
  std::error_code error;
  if (!keep) {
    fs::remove_all(results, error);
    return {};
  }
  const fs::path target = folder_ / kept_run(run);
  fs::create_directories(target.parent_path(), error);
  fs::remove_all(target, error);
  // A run that failed before it wrote anything has no folder.
  if (fs::exists(results, error)) fs::rename(results, target, error);
  if (error) {
    return fail(ErrorCode::kIo, "cannot keep `{}`: {}", target.string(), error.message());
  }
  if (rule == KeepRecordings::kExtremes) remove_others(run.condition, rows);
  return {};
}

}  // namespace rave::experiment
