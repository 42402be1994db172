// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "rave/gui_server/source.hpp"

namespace rave::gui_server {

/// What one page is sent of the maps that it shows: tiles that it does not have as they are now, a
/// few at a time. The thread of the server.
class MapStream {
 public:
  /// Tiles between two pictures, of some 4 KB each.
  static constexpr std::size_t kMostAtOnce = 16;

  /// The page shows these from now on; it has forgotten the others.
  void look(std::vector<MapName> maps);
  [[nodiscard]] const std::vector<MapName>& looked_at() const noexcept { return maps_; }
  /// Whether there may be something to send.
  [[nodiscard]] bool due(const Source& source) const noexcept {
    return !maps_.empty() && (left_ || revision_ != source.maps_revision());
  }
  void send(const Source& source, const std::function<void(std::string tile)>& send);

 private:
  std::vector<MapName> maps_;
  /// Of each tile that the page has, its revision; by map, row and column.
  std::map<std::tuple<MapName, std::uint32_t, std::uint32_t>, std::uint64_t> told_;
  std::uint64_t revision_ = 0;
  bool left_ = false;  ///< Not all went out the last time.
};

}  // namespace rave::gui_server
