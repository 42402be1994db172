// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/replay/verify.hpp"

namespace rave::runtime {

/// How far a robot is from itself in another run, at equal times of the runs.
struct RobotDistance {
  std::string robot;
  double last_m = 0;  ///< At the last time that both runs have.
  double most_m = 0;
  double most_at_s = 0;
  /// The first time at which their places differ; empty: never.
  std::optional<double> from_s;
};

/// What differs between two recorded runs.
struct RunDiff {
  std::optional<RunDifference> first;  ///< Empty: all that both have is equal to the bit.
  std::uint64_t messages = 0;          ///< That were compared.
  double common_s = 0;                 ///< The time that both runs have.
  /// Robots of both runs by name, in the order of the first one.
  std::vector<RobotDistance> robots;
  std::vector<std::string> only_first;  ///< Names of robots of one run alone.
  std::vector<std::string> only_second;
};

/// Compares two recordings: where they part first, and how far apart they are after. Places are
/// true ones, of real robots reported ones. Errors: those of reading them; kInvalidArgument (they
/// have no common robot, or other steps).
[[nodiscard]] Result<RunDiff> diff_runs(const std::filesystem::path& first,
                                        const std::filesystem::path& second);

}  // namespace rave::runtime
