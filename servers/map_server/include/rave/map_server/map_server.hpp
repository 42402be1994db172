// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <tuple>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/config.hpp"
#include "rave/bus/writer.hpp"
#include "rave/maps/team_maps.hpp"
#include "rave/onlook/listener.hpp"
#include "rave/watch/observer.hpp"

namespace rave::map_server {

/// The Map Server of one run on the bus. One owner thread.
class MapServer {
 public:
  struct Counts {
    std::size_t robots = 0;      ///< Robots of which tiles have come.
    std::uint64_t received = 0;  ///< Tiles.
    std::uint64_t published = 0;
  };

  /// Joins the run of `config`. Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<MapServer> open(const bus::BusConfig& config);

  /// Serves for `span`, or until a stop is requested. Returns false at the end of the run.
  bool serve(Duration span, const std::stop_token& stop);
  [[nodiscard]] Counts counts() const noexcept;
  /// Why a map could not be combined, of the last one; empty: all could be.
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

 private:
  MapServer(std::unique_ptr<watch::Observer> observer, onlook::Listener listener,
            bus::Writer<bus::MapTile> tiles)
      : observer_(std::move(observer)), listener_(std::move(listener)), tiles_(std::move(tiles)) {}
  void learn(const watch::RunView& view);
  void publish();

  std::unique_ptr<watch::Observer> observer_;
  onlook::Listener listener_;
  bus::Writer<bus::MapTile> tiles_;
  std::vector<std::string> teams_;  ///< By robot; empty: not known yet.
  std::optional<maps::TeamMaps> maps_;
  /// The last tile of each place, by robot, row and column: teams may become known later.
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, maps::MapTile> kept_;
  std::set<std::uint32_t> heard_;  ///< Robots of which tiles have come.
  std::uint64_t received_ = 0;
  std::uint64_t published_ = 0;
  std::string problem_;
};

/// The tiles of the map `name` (of a robot, or global) of the run of `config`, newest last: those
/// that come within `patience`, until none has come for a second. Errors: kNotFound (no such map;
/// says which there are), those of bus::Bus::open().
[[nodiscard]] Result<std::vector<maps::MapTile>> fetch(const bus::BusConfig& config,
                                                       const std::string& name, Duration patience,
                                                       const std::stop_token& stop);

}  // namespace rave::map_server
