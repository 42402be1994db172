// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "rave/config/scenario_file.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/results/facts.hpp"

namespace rave::runtime {

/// How long a sighting waits for newer poses of the real robots; if none arrive, the last ones are
/// used.
inline constexpr Duration kLongestWaitForPoses = from_seconds(0.8);

/// An independent test of poses: compares every sighting of a robot's real camera with the reading
/// of a virtual camera on the same robot at the same time. A sighting is compared when poses from
/// before and after it are known, so the result does not depend on the step of the run. Sightings
/// at the end of a run without later poses are not compared.
class SightingCheck final : public RunObserver {
 public:
  SightingCheck(const config::SightingsCheckFile& file, const sim::EngineSpec& spec);

  void after_step(const StepView& step) override;

  [[nodiscard]] const SightingFacts& facts() const noexcept { return facts_; }

 private:
  struct Pair {
    RobotId robot;
    std::uint32_t real = 0;
    std::uint32_t twin = 0;
    std::uint32_t seen_sequence = 0;
    std::int64_t seen_stamp_ns = -1;
  };
  struct Waiting {
    std::size_t pair = 0;
    Sighting sighting;
  };
  void learn(const sim::Engine& engine);
  void gather(const sim::Engine& engine, std::size_t pair);
  void compare(sim::Engine& engine, const Pair& pair, const Sighting& sighting);

  config::SightingsCheckFile limits_;
  std::vector<Pair> pairs_;
  std::set<std::int32_t> known_codes_;
  /// Number of obstacles added during the run that are in known_codes_.
  std::size_t known_added_ = 0;
  std::vector<Waiting> waiting_;
  std::vector<Sighting> twin_;  ///< Readings of the virtual camera; memory reused.
  SightingFacts facts_;
};

/// The number of sightings that count: all with known codes, and those with unknown codes beyond
/// the permitted number of misreadings.
[[nodiscard]] std::uint64_t counted(const config::SightingsCheckFile& limits,
                                    const SightingTally& all);

/// Percentage of the counted sightings that agree; 0 if there are none.
[[nodiscard]] double within_pct(const config::SightingsCheckFile& limits, const SightingTally& all);

/// Whether there are enough sightings, and enough of them agree.
[[nodiscard]] bool holds(const config::SightingsCheckFile& limits, const SightingTally& all);

}  // namespace rave::runtime
