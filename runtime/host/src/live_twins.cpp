// SPDX-License-Identifier: Apache-2.0
#include "live_twins.hpp"

#include <algorithm>

#include "host_session.hpp"

namespace rave::runtime {

LiveTwins::LiveTwins(const sim::Engine& engine, std::span<const RobotId> own)
    : local_(own.begin(), own.end()) {
  for (const RobotId robot : own) {
    const sim::RobotSpec& its = engine.spec().robots[robot.value()];
    if (its.twin) own_.push_back({robot, its.type});
  }
}

Status LiveTwins::follow(sim::Engine& engine, real_time::LiveWorld& live,
                         real_time::HostLink& link) {
  bool changed = false;
  for (Own& one : own_) {
    const std::uint32_t type = engine.spec().robots[one.robot.value()].type;
    if (type == one.type) continue;
    one.type = type;
    changed = true;
    RAVE_TRY(live.serve(one.robot, type, engine.true_pose(one.robot)));
  }
  if (changed) link.count_real(real_robots(engine.spec(), local_));
  for (const real_time::RobotReality& heard : link.take_realities()) {
    if (engine.show_reality(heard.robot, heard.simulated)) {
      live.set_reality(heard.robot, heard.simulated);
    }
  }
  return {};
}

Result<std::vector<std::uint32_t>> hosts_of_twins(const config::ExpandedScenario& scenario,
                                                  const sim::EngineSpec& spec) {
  const bool any = std::any_of(spec.robots.begin(), spec.robots.end(),
                               [](const sim::RobotSpec& robot) { return robot.twin.has_value(); });
  if (!any) return std::vector<std::uint32_t>();
  RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(scenario));
  std::vector<std::uint32_t> host_of(spec.robots.size());
  for (std::uint32_t h = 0; h < hosts.size(); ++h) {
    for (const std::size_t robot : hosts[h].robots) host_of[robot] = h;
  }
  return host_of;
}

}  // namespace rave::runtime
