// SPDX-License-Identifier: Apache-2.0
#include "page/map_stream.hpp"

#include <algorithm>

#include "page/frames.hpp"

namespace rave::gui_server {

void MapStream::look(std::vector<MapName> maps) {
  maps_ = std::move(maps);
  std::erase_if(told_, [this](const auto& tile) {
    return !std::binary_search(maps_.begin(), maps_.end(), std::get<0>(tile.first));
  });
  left_ = true;
}

void MapStream::send(const Source& source, const std::function<void(std::string tile)>& send) {
  if (!due(source)) return;
  revision_ = source.maps_revision();
  left_ = false;
  std::size_t sent = 0;
  for (const MapName& name : maps_) {
    const MapShown* const map = source.map(name);
    if (map == nullptr) continue;
    for (const auto& [place, tile] : map->tiles) {
      std::uint64_t& told = told_[{name, place.first, place.second}];
      if (told == tile.revision) continue;
      if (sent == kMostAtOnce) {
        left_ = true;
        return;
      }
      ++sent;
      told = tile.revision;
      send(encode_tile(name, *map, place.first, place.second));
    }
  }
}

}  // namespace rave::gui_server
