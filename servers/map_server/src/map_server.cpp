// SPDX-License-Identifier: Apache-2.0
#include "rave/map_server/map_server.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "rave/maps/map_messages.hpp"

namespace rave::map_server {
namespace {

constexpr Duration kRound = from_seconds(0.1);
constexpr Duration kQuiet = from_seconds(1);

bool is_over(watch::Phase phase) {
  return phase == watch::Phase::kEnded || phase == watch::Phase::kFailed;
}

}  // namespace

Result<MapServer> MapServer::open(const bus::BusConfig& config) {
  RAVE_TRY_ASSIGN(auto observer, watch::Observer::open(config));
  RAVE_TRY_ASSIGN(auto listener, onlook::Listener::create(observer->bus()));
  RAVE_TRY_ASSIGN(auto tiles, bus::Writer<bus::MapTile>::create(observer->bus()));
  return MapServer(std::move(observer), std::move(listener), std::move(tiles));
}

/// The teams of all robots. When more of them are known, the maps are combined anew.
void MapServer::learn(const watch::RunView& view) {
  std::vector<std::string> teams;
  for (const watch::RobotView& robot : view.robots) {
    if (robot.number >= teams.size()) teams.resize(std::size_t{robot.number} + 1);
    if (!robot.name.empty()) teams[robot.number] = robot.team.empty() ? "robots" : robot.team;
  }
  if (teams == teams_ || teams.empty()) return;
  teams_ = teams;
  maps_.emplace(std::move(teams));
  for (const auto& [place, tile] : kept_) static_cast<void>(maps_->add(tile));
}

bool MapServer::serve(Duration span, const std::stop_token& stop) {
  for (Duration done; done < span && !stop.stop_requested(); done = done + kRound) {
    onlook::Asked asked;
    for (std::uint32_t robot = 0; robot < teams_.size(); ++robot) asked.maps.push_back(robot);
    listener_.look(asked);
    observer_->watch(kRound, stop);
    listener_.hear();
    const watch::RunView view = observer_->view(true);
    learn(view);
    for (maps::MapTile& tile : listener_.take_tiles()) {
      // Others are global, as those that it publishes itself.
      if (tile.robot == maps::kNoRobot) continue;
      ++received_;
      heard_.insert(tile.robot);
      if (maps_) {
        if (const Status added = maps_->add(tile); !added) problem_ = added.error().message;
      }
      kept_.insert_or_assign({tile.robot, tile.row, tile.column}, std::move(tile));
    }
    publish();
    if (is_over(view.phase)) return false;
  }
  return true;
}

void MapServer::publish() {
  if (!maps_) return;
  for (maps::MapTile& tile : maps_->changed()) {
    bus::MapTile message = maps::message_of(tile);
    // A monitor that is too slow gets the next tile of this place.
    if (tiles_.write(message)) ++published_;
  }
}

MapServer::Counts MapServer::counts() const noexcept {
  return {heard_.size(), received_, published_};
}

Result<std::vector<maps::MapTile>> fetch(const bus::BusConfig& config, const std::string& name,
                                         Duration patience, const std::stop_token& stop) {
  RAVE_TRY_ASSIGN(const auto observer, watch::Observer::open(config));
  RAVE_TRY_ASSIGN(auto listener, onlook::Listener::create(observer->bus()));
  std::vector<maps::MapTile> found;
  std::set<std::string> names;
  Duration quiet;
  for (Duration waited; waited < patience && !stop.stop_requested(); waited = waited + kRound) {
    onlook::Asked asked;
    for (const watch::RobotView& robot : observer->view(true).robots) {
      if (!robot.name.empty()) names.insert(robot.name);
      if (robot.name == name) asked.maps.push_back(robot.number);
    }
    listener.look(asked);
    observer->watch(kRound, stop);
    listener.hear();
    quiet = quiet + kRound;
    for (maps::MapTile& tile : listener.take_tiles()) {
      names.insert(tile.source);
      if (tile.source != name) continue;
      found.push_back(std::move(tile));
      quiet = {};
    }
    if (!found.empty() && quiet >= kQuiet) break;
  }
  if (!found.empty()) return found;
  const bool global = name.starts_with("global");
  if (names.contains(name)) {
    return fail(ErrorCode::kNotFound, "robot `{}` has no map: it has no range sensor, or no pose",
                name);
  }
  return fail(ErrorCode::kNotFound, "no map `{}`; known: {}{}", name, fmt::join(names, ", "),
              global ? "\na global map needs `rave map-server` beside the run" : "");
}

}  // namespace rave::map_server
