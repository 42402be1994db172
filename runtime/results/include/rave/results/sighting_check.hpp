// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "rave/config/scenario_file.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/results/facts.hpp"

namespace rave::runtime {

/// How long a sighting waits for poses of the real robots that are newer than it; where none come,
/// the last one holds.
inline constexpr Duration kLongestWaitForPoses = from_seconds(0.8);

/// The independent witness: every sighting of a robot's real camera is compared with what the
/// virtual camera on the same robot says at that very instant. It is compared when poses from
/// before and after it are known, so that the step of the run is no part of the result; those of
/// the last moments of a run, of which that cannot be said, are not compared.
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
  std::size_t known_added_ = 0;  ///< Of the obstacles that came while the run went.
  std::vector<Waiting> waiting_;
  std::vector<Sighting> twin_;  ///< What the virtual camera reads, reused.
  SightingFacts facts_;
};

/// How many sightings count: all with known codes, and those with unknown ones that are too many
/// to be misread.
[[nodiscard]] std::uint64_t counted(const config::SightingsCheckFile& limits,
                                    const SightingTally& all);

/// Share of those that agree; 0 if there are none.
[[nodiscard]] double within_pct(const config::SightingsCheckFile& limits, const SightingTally& all);

/// Whether enough was seen, and of that enough agrees.
[[nodiscard]] bool holds(const config::SightingsCheckFile& limits, const SightingTally& all);

}  // namespace rave::runtime
