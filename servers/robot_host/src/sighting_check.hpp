// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "observer.hpp"
#include "rave/config/scenario_file.hpp"

namespace rave::robot_host {

/// How many real sightings the virtual camera confirms.
struct SightingTally {
  std::uint64_t total = 0;    ///< With a code that the world knows.
  std::uint64_t within = 0;   ///< Of these: range and bearing agree.
  std::uint64_t unknown = 0;  ///< With a code that the world does not know.

  [[nodiscard]] double within_pct() const noexcept {
    return total == 0 ? 0 : 100.0 * static_cast<double>(within) / static_cast<double>(total);
  }
};

/// The independent witness: every sighting of a robot's real camera is compared with what the
/// virtual camera on the same robot says at that very instant.
class SightingCheck final : public Observer {
 public:
  SightingCheck(const config::SightingsCheckFile& file, const sim::EngineSpec& spec);

  void after_step(sim::Engine& engine) override;

  [[nodiscard]] const SightingTally& all() const noexcept { return all_; }
  /// By robot name.
  [[nodiscard]] const std::map<std::string, SightingTally>& by_robot() const noexcept {
    return by_robot_;
  }
  [[nodiscard]] const std::map<std::int32_t, std::uint64_t>& unknown_codes() const noexcept {
    return unknown_codes_;
  }
  [[nodiscard]] const config::SightingsCheckFile& limits() const noexcept { return limits_; }
  [[nodiscard]] bool holds() const noexcept {
    return all_.total > 0 && all_.within_pct() >= limits_.min_within_pct;
  }

 private:
  struct Pair {
    RobotId robot;
    std::uint32_t real = 0;
    std::uint32_t twin = 0;
    std::uint32_t seen_sequence = 0;
    std::int64_t seen_stamp_ns = -1;
  };
  void compare(sim::Engine& engine, const Pair& pair, const Sighting& sighting);

  config::SightingsCheckFile limits_;
  std::vector<Pair> pairs_;
  std::set<std::int32_t> known_codes_;
  std::size_t known_added_ = 0;  ///< Of the obstacles that came while the run went.
  std::vector<Sighting> twin_;   ///< What the virtual camera reads, reused.
  SightingTally all_;
  std::map<std::string, SightingTally> by_robot_;
  std::map<std::int32_t, std::uint64_t> unknown_codes_;
};

}  // namespace rave::robot_host
