// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"

// The workload of `rave bench swarm`: robots that avoid boxes and one another in an arena, as an
// ordinary scenario. See docs/benchmarks.md.
namespace rave::swarm {

/// The range sensor of each robot.
enum class Sensing : std::uint8_t {
  kA,  ///< 16 rays over the full circle, 3 m.
  kB,  ///< 180 rays over 180 degrees, 8 m.
};
enum class Noise : std::uint8_t {
  kNone,
  kGaussian,  ///< Of kNoiseSigma_m on every range.
};

inline constexpr double kStep_s = 0.1;  ///< Sensing and deciding come once a step.
inline constexpr double kNoiseSigma_m = 0.01;
inline constexpr std::uint32_t kMostRobots = 100'000;

[[nodiscard]] std::string_view to_string(Sensing sensing) noexcept;
[[nodiscard]] std::string_view to_string(Noise noise) noexcept;
[[nodiscard]] std::uint32_t rays_of(Sensing sensing) noexcept;
[[nodiscard]] double range_max_m(Sensing sensing) noexcept;

struct Workload {
  Sensing sensing = Sensing::kA;
  std::uint32_t robots = 1000;  ///< 1 to kMostRobots.
  Noise noise = Noise::kNone;
  int threads = 1;
  std::uint64_t seed = 1;  ///< Of the places and of all chance in the run.
};

/// The scenario, as expand_scenario would read it from the files that write_scenario makes. The
/// same workload gives the same scenario, everywhere. Errors: kInvalidArgument (number of robots).
[[nodiscard]] Result<config::ExpandedScenario> make_scenario(const Workload& workload,
                                                             double duration_s);

/// Writes scenario.yaml, world.yaml and robot.yaml into a folder, which is made if need be. What
/// stands there is replaced. Errors: kInvalidArgument (number of robots), kIo.
Status write_scenario(const Workload& workload, double duration_s,
                      const std::filesystem::path& folder);

}  // namespace rave::swarm
