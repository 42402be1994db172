// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/maps/map_tile.hpp"

namespace rave::maps {

/// The combination of what several maps say of one cell, in percent: by Bayes' rule for independent
/// observers, log odds(all) = prior + sum over them of (log odds - prior). kUnknown if it is
/// unknown to all. What a map says is limited to 1 to 99 %. `prior`: percent, 1 to 99.
[[nodiscard]] std::uint8_t combined(const std::vector<std::uint8_t>& cells, double prior = 50);

/// The map that several robots make together, of the newest tiles of their local maps. A value; one
/// thread at a time. The same tiles in any order of robots give the same map.
class GlobalMap {
 public:
  explicit GlobalMap(std::string name = "global", double prior = 50)
      : name_(std::move(name)), prior_(prior) {}

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  /// Takes a tile of a robot's map; an older one than known is ignored. Errors: kInvalidArgument
  /// (cells of another size than those of the others, or not in line with them).
  Status add(const MapTile& tile);
  /// The tiles that changed since the last call; all of them if the frame has grown.
  [[nodiscard]] std::vector<MapTile> changed();
  [[nodiscard]] bool empty() const noexcept { return places_.empty(); }
  /// All tiles.
  [[nodiscard]] std::vector<MapTile> tiles() const;

 private:
  struct Local {
    SimTime stamp;
    std::vector<std::uint8_t> cells;
  };
  struct Place {
    std::map<std::uint32_t, Local> locals;  ///< By robot.
    std::uint32_t revision = 0;
    bool changed = false;
  };
  /// Row and column of a tile, counted from the origin of the world.
  using Where = std::pair<std::int64_t, std::int64_t>;

  void grow(const Where& low, const Where& high);
  [[nodiscard]] MapTile tile_at(const Where& where, const Place& place) const;

  std::string name_;
  double prior_;
  double resolution_m_ = 0;
  Vec2 phase_W_;      ///< A corner of a tile.
  Where low_, high_;  ///< Tiles of the frame: from low to before high.
  std::map<Where, Place> places_;
};

}  // namespace rave::maps
