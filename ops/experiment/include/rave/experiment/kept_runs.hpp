// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "rave/base/result.hpp"
#include "rave/experiment/ledger.hpp"
#include "rave/experiment/plan.hpp"

namespace rave::experiment {

/// The folder of a kept run below that of the sweep: `runs/c1-s7`, by condition (from 1) and seed.
[[nodiscard]] std::filesystem::path kept_run(const PlannedRun& run);

/// Which runs keep their folder with the recording, by the rule of the experiment. One thread at a
/// time.
class KeptRuns {
 public:
  /// `folder`: that of the sweep. Borrows the plan.
  KeptRuns(const Plan& plan, std::filesystem::path folder)
      : plan_(plan), folder_(std::move(folder)) {}

  /// Whether runs must be recorded.
  [[nodiscard]] bool record() const;
  /// Keeps or removes the folder of a run that has just ended. `rows` has its row, too.
  Status settle(const PlannedRun& run, const std::filesystem::path& results, const RunRows& rows);

 private:
  [[nodiscard]] bool is_extreme(const PlannedRun& run, const RunRows& rows) const;
  void remove_others(std::size_t condition, const RunRows& rows) const;

  const Plan& plan_;
  std::filesystem::path folder_;
};

}  // namespace rave::experiment
