// SPDX-License-Identifier: Apache-2.0
#include "live_listener.hpp"

#include "onlooker.hpp"

namespace rave::cli_test {

Result<std::unique_ptr<LiveListener>> LiveListener::open(const bus::RunId& run,
                                                         const std::vector<std::string>& apart) {
  RAVE_TRY_ASSIGN(auto bus, join_as_onlooker(run, apart));
  RAVE_TRY_ASSIGN(auto worlds, bus::Reader<bus::World>::create(*bus));
  RAVE_TRY_ASSIGN(auto states, bus::Reader<bus::HostState>::create(*bus));
  RAVE_TRY_ASSIGN(auto runs, bus::Reader<bus::RunState>::create(*bus));
  return std::unique_ptr<LiveListener>(
      new LiveListener(std::move(bus), std::move(worlds), std::move(states), std::move(runs)));
}

void LiveListener::listen() {
  worlds_.take([this](const bus::World& world) {
    worlds.push_back({world.step, world.writer, world.time_ns});
    const auto ids = bus::elements(world.robots.id);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      places[ids[i]] = {world.robots.x_m._buffer[i], world.robots.y_m._buffer[i],
                        world.robots.stamp_ns._buffer[i]};
    }
    const auto silent = bus::elements(world.stale);
    stale = {silent.begin(), silent.end()};
  });
  states_.take([this](const bus::HostState& state) {
    const auto ids = bus::elements(state.resolved.id);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      stamps_ns[ids[i]].push_back(state.resolved.stamp_ns._buffer[i]);
    }
  });
  runs_.take([this](const bus::RunState& state) {
    run = state;
    run->hosts = {};
    for (const auto& host : bus::elements(state.hosts)) hosts[host.name] = host;
  });
}

}  // namespace rave::cli_test
