// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/swarm/swarm_run.hpp"
#include "rave/swarm/workload.hpp"

namespace rave::swarm {

struct CompareOptions {
  std::filesystem::path a;  ///< A folder of a build, or an executable `rave`.
  std::filesystem::path b;
  Workload workload;
  RunEnd end;  ///< With seconds: as many steps as A does in that time, for both.
  int rounds = 7;
  bool allow_different_hash = false;
};

/// Middle and spread of numbers; percentiles between two of them are interpolated.
struct Spread {
  double median = 0;
  double p10 = 0;
  double p90 = 0;
};
[[nodiscard]] Spread spread_of(std::vector<double> values);

/// The measurements of one build.
struct ComparedBuild {
  std::filesystem::path executable;
  std::vector<double> robot_steps_per_s;  ///< One for each round.
  std::string hash;
};

struct Comparison {
  Workload workload;
  std::uint64_t steps = 0;  ///< Of each run.
  ComparedBuild a;
  ComparedBuild b;
  Spread ratio;  ///< B over A, round by round: above 1, B is faster.

  [[nodiscard]] bool same_hash() const noexcept { return a.hash == b.hash; }
};

/// The executable of a build: the file itself, or `bin/rave` or `rave` in a folder. Error:
/// kNotFound, with what was looked for.
[[nodiscard]] Result<std::filesystem::path> find_rave(const std::filesystem::path& build);

/// Runs both builds in turn; the order changes with each round. Each uses its own plug-ins,
/// independent of RAVE_PLUGIN_PATH and RAVE_SHARE, and writes messages to the standard error of
/// this process. Errors: kNotFound (a build), kIo (a build cannot be started), kState (a run that
/// failed or had unexpected output, a build that gives two hashes for the same run, builds with
/// different hashes unless that is allowed).
[[nodiscard]] Result<Comparison> compare(const CompareOptions& options);

/// One line of JSON without a newline; docs/benchmarks.md explains the keys.
[[nodiscard]] std::string comparison_json(const Comparison& comparison);
/// The same as a sentence for people.
[[nodiscard]] std::string comparison_text(const Comparison& comparison);

}  // namespace rave::swarm
