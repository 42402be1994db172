// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rave/maps/local_map.hpp"

namespace rave::maps {

/// The local maps of the robots of one host. A map is begun when somebody first asks for it, and is
/// then kept up to date until the run is over, so that it is whole when it is looked at again; only
/// if there is no room, one that nobody asks for makes place for another.
/// Without one nothing is computed. The thread of the run.
class LocalMaps {
 public:
  using Clock = std::chrono::steady_clock;

  /// Each takes 3 MB, and some time of each step in which its robot senses.
  static constexpr std::size_t kMost = 16;
  /// Between two times at which tiles are given.
  static constexpr std::chrono::milliseconds kInterval{500};

  /// `robots`: all that are asked for now. Begins their maps, as far as they are possible and there
  /// is room. To be called again as long as they are asked for: a robot may not have said yet where
  /// it is.
  void ask(const sim::Engine& engine, std::span<const std::uint32_t> robots);
  /// A step is done.
  void after_step(const sim::Engine& engine);
  /// Tiles that changed, if it is time; empty otherwise. `slower`: so many times rarer, at least 1.
  [[nodiscard]] std::vector<MapTile> changed(Clock::time_point now, int slower);
  [[nodiscard]] bool empty() const noexcept { return maps_.empty(); }
  [[nodiscard]] std::size_t count() const noexcept { return maps_.size(); }

 private:
  std::vector<std::unique_ptr<LocalMap>> maps_;
  Clock::time_point next_{};
};

}  // namespace rave::maps
