// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "rave/experiment/sweep.hpp"

namespace rave::experiment {

/// How a sweep is given to Slurm.
struct SlurmOptions {
  std::size_t tasks = 1;             ///< Tasks of the job array; each is a shard.
  std::vector<std::string> options;  ///< More words for `sbatch`, such as `--partition=short`.
};

/// Does the missing runs of a plan as a job array of Slurm, and waits for it. Every node must reach
/// the experiment and the folder by the same paths. A task that ends early, as with a lost node,
/// has lost nothing of what it wrote: the array is submitted again as long as that brings new runs.
/// When `stop` says so, the job is cancelled. Then it writes `runs.csv`, as sweep() does. Errors:
/// those of sweep(); kNotFound (no `sbatch` in PATH); kIo (Slurm refuses the job, with its reason).
[[nodiscard]] Result<SweepOutcome> sweep_on_slurm(const Plan& plan, const SweepOptions& options,
                                                  const SlurmOptions& slurm);

}  // namespace rave::experiment
