// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/experiment/ledger.hpp"
#include "rave/experiment/plan.hpp"

namespace rave::experiment {

/// A part of the runs of a plan: those whose number leaves the remainder `index` modulo `count`.
struct Shard {
  std::size_t index = 0;  ///< From 0.
  std::size_t count = 1;
};

/// How far a sweep is.
struct SweepProgress {
  std::size_t runs = 0;  ///< Of the plan, or of the shard.
  std::size_t done = 0;
  std::size_t failed = 0;      ///< Of those done.
  std::size_t conditions = 0;  ///< With all of their runs done.
  double left_s = 0;           ///< Expected wall time; 0: unknown.
};

struct SweepOptions {
  std::filesystem::path program;       ///< The executable `rave`.
  std::vector<std::string> arguments;  ///< More words for `rave run`.
  std::filesystem::path folder;        ///< Created if it is missing.
  std::size_t jobs = 1;                ///< Runs at a time; at least 1.
  Shard shard;
  bool retry = false;  ///< Also does runs again that have failed.
  /// Asked by any thread, several times a second; true ends the sweep. May be empty.
  std::function<bool()> stop;
  /// Called by any thread, one at a time, after each run; may be empty.
  std::function<void(const SweepProgress&)> on_progress;
};

/// What a sweep leaves.
struct SweepOutcome {
  SweepProgress progress;
  std::size_t begun = 0;    ///< Runs that this call did.
  std::size_t missing = 0;  ///< Runs of the whole plan that are not done.
  std::vector<std::string> notes;
  RunRows rows;
};

/// Does the runs of a plan that its folder does not have, and writes `runs.csv` with all finished
/// runs. The folder has `experiment.yaml`, `plan.json`, the ledgers and kept runs; it may be called
/// again after an end at any moment. A shard writes a ledger of its own and no table. Errors:
/// kState (another sweep is at work there, or the folder is of another experiment), kIo, those of
/// run_process().
[[nodiscard]] Result<SweepOutcome> sweep(const Plan& plan, const SweepOptions& options);

/// A run whose repetition gave something else.
struct SweepDifference {
  PlannedRun run;
  RunRow recorded;
  RunRow repeated;
};

/// Repeats `count` finished runs, chosen at random by `seed`, and compares values and hashes.
/// Writes nothing into the folder but temporary files. Errors: those of sweep(); kNotFound (no run
/// is finished).
[[nodiscard]] Result<std::vector<SweepDifference>> repeat_sample(const Plan& plan,
                                                                 const SweepOptions& options,
                                                                 std::size_t count,
                                                                 std::uint64_t seed);

/// The plan of the folder of a sweep, without building its scenarios. Errors: kNotFound (no sweep),
/// kParse.
[[nodiscard]] Result<Plan> read_plan(const std::filesystem::path& folder);

}  // namespace rave::experiment
