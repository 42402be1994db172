// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rave/maps/local_map.hpp"

namespace rave::maps {

/// The local maps of the robots of one host. A map is created when first requested and kept up to
/// date until the end of the run, so that it is complete whenever it is viewed. Only if there is no
/// room, a map without requests is replaced. Without maps there is no cost. Thread: that of the
/// run.
class LocalMaps {
 public:
  using Clock = std::chrono::steady_clock;

  /// Each map takes 3 MB, and time in each step in which its robot senses.
  static constexpr std::size_t kMost = 16;
  /// Time between two sets of tiles.
  static constexpr std::chrono::milliseconds kInterval{500};

  /// `robots`: all that are requested now. Creates their maps, as far as possible and as far as
  /// there is room. Call it again while requests last: a robot may not have reported a pose yet.
  void ask(const sim::Engine& engine, std::span<const std::uint32_t> robots);
  /// Adds the readings of a completed step.
  void after_step(const sim::Engine& engine);
  /// The changed tiles, if they are due; empty otherwise. `slower`: factor of the interval, at
  /// least 1.
  [[nodiscard]] std::vector<MapTile> changed(const sim::Engine& engine, Clock::time_point now,
                                             int slower);
  [[nodiscard]] bool empty() const noexcept { return maps_.empty(); }
  [[nodiscard]] std::size_t count() const noexcept { return maps_.size(); }

 private:
  std::vector<std::unique_ptr<LocalMap>> maps_;
  Clock::time_point next_{};
};

}  // namespace rave::maps
