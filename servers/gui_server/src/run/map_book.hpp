// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "rave/gui_server/source.hpp"
#include "rave/maps/map_tile.hpp"

namespace rave::gui_server {

/// The maps of a run as far as they are known: of each place the newest tile. One thread.
class MapBook {
 public:
  /// The limit for a sender that invents maps: some 70 MB.
  static constexpr std::size_t kMostTiles = 16'384;
  static constexpr std::size_t kMostGlobals = 64;

  /// `robots_json`: as a Source gives it; robots with range sensors can make maps.
  /// `bodies_json`: the same; what stands as in the world file is a map of its own.
  MapBook(const std::string& robots_json, const std::string& bodies_json);

  /// Takes a tile in; one that is older than what is known, of a robot that can make no map, or for
  /// which there is no room is left out.
  void add(const maps::MapTile& tile);

  /// What can be looked at, robots in order, then global maps by name.
  [[nodiscard]] const std::vector<MapName>& names() const noexcept { return names_; }
  /// Another number whenever names() changed.
  [[nodiscard]] std::uint64_t names_revision() const noexcept { return names_revision_; }
  /// Another number whenever a tile came.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  /// Null: nothing is known of it yet.
  [[nodiscard]] const MapShown* find(const MapName& name) const;

 private:
  std::vector<MapName> names_;
  std::uint64_t names_revision_ = 1;
  std::uint64_t revision_ = 1;
  std::size_t tiles_ = 0;
  std::size_t globals_ = 0;
  std::map<MapName, MapShown> maps_;  ///< Local ones by their slot alone.
};

}  // namespace rave::gui_server
