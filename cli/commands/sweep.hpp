// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave sweep`.
struct SweepCommand {
  std::string experiment;  ///< A file, a folder with experiment.yaml, or a name.
  std::string output;      ///< Empty: sweeps/NAME.
  std::optional<std::uint64_t> jobs;
  std::string shard;                    ///< `I/N`; empty: all runs.
  std::optional<std::uint64_t> verify;  ///< Repeat this number of finished runs instead.
  std::optional<std::uint64_t> slurm;   ///< Tasks of a job array; unset: runs on this machine.
  std::vector<std::string> slurm_options;
  bool retry = false;
  bool quiet = false;
  std::vector<std::string> plugins;
};

/// Does the runs of an experiment that are missing. Returns 0 if all are done and whole, 1 if not,
/// 2 on bad input.
[[nodiscard]] Result<int> sweep(const SweepCommand& options);

}  // namespace rave::cli
