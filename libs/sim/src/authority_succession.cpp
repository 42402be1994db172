// SPDX-License-Identifier: Apache-2.0
// An authority in the place of another one, or of a host.
#include <algorithm>
#include <iterator>

#include "world_authority_impl.hpp"

namespace rave::sim {

AuthorityState WorldAuthority::state(bool with_obstacles) const {
  const Impl& authority = *impl_;
  AuthorityState state;
  state.hash = authority.hash;
  state.events = authority.events;
  state.pinned = authority.truth.pinned();
  for (const auto& [robot, scale] : authority.truth.scales()) {
    state.scales.push_back({RobotId(robot), scale});
  }
  state.inputs = authority.inputs;
  state.obstacle_changes = authority.history.count();
  if (with_obstacles) state.obstacles = authority.history.changes();
  state.refused_count = authority.refused_count;
  state.refused = authority.refused;
  if (authority.spec.conductor) state.conductor = authority.spec.conductor->state();
  // Hosts receive the contacts and pins of the last step and keep them, so that the results
  // outlive this process.
  std::ranges::copy_if(authority.done_events, std::back_inserter(state.done), [](const Event& e) {
    return e.kind == EventKind::kContact || e.kind == EventKind::kPinned;
  });
  return state;
}

Status WorldAuthority::resume(const WorldStep& world, const AuthorityState& state) {
  Impl& authority = *impl_;
  RAVE_TRY(check_taken_over(authority.spec, world, state, true));
  // All that is checked above; from here on the old state is gone.
  authority.begin();
  if (authority.spec.conductor) RAVE_TRY(authority.spec.conductor->resume(state.conductor));
  for (const ResizedRobot& resized : state.scales) {
    RAVE_TRY(authority.truth.put_scale(resized.robot, resized.scale));
  }
  const SimTime now{static_cast<std::int64_t>(world.step) * authority.spec.step.ns};
  // First what had changed before that world, then what it brought: numbers of added obstacles
  // follow from the order.
  authority.truth.put_obstacles(state.obstacles, now);
  authority.truth.put_obstacles(world.obstacles, now);
  authority.history = ObstacleHistory(state.obstacles, state.obstacle_changes);
  authority.last_obstacles = world.obstacles;
  authority.truth.adopt_robots(world);
  authority.truth.adopt_contacts(world);
  authority.truth.take_over(now, state.pinned);
  authority.step = world.step + 1;
  authority.hash = state.hash;
  authority.done_hash = state.hash;
  authority.done_events = state.done;  // a host that gets that world again gets them again
  authority.events = state.events;
  authority.refused_count = state.refused_count;
  authority.refused = state.refused;
  authority.put_refusal_texts(world.step);
  authority.inputs = state.inputs;
  // What the scenario has up to that step is in the state already.
  const auto& changes = authority.spec.changes;
  while (authority.next_change < changes.size() &&
         changes[authority.next_change].step <= world.step) {
    ++authority.next_change;
  }
  const auto& obstacles = authority.spec.obstacle_changes;
  while (authority.next_obstacle < obstacles.size() &&
         obstacles[authority.next_obstacle].step <= world.step) {
    ++authority.next_obstacle;
  }
  return {};
}

/// Of events the texts are not told, but those of changes that were refused are, and in their
/// order.
void WorldAuthority::Impl::put_refusal_texts(std::uint64_t in_step) {
  auto next = std::ranges::find_if(refused, [&](const Event& one) { return one.step == in_step; });
  for (Event& event : events) {
    if (event.kind != EventKind::kChangeRefused) continue;
    event.text = next != refused.end()
                     ? next++->text
                     : "refused; the reason is known only to the previous manager";
  }
}

void WorldAuthority::speak_for(std::uint32_t host, HostReport& report) const {
  const Impl& authority = *impl_;
  // Poses stay: the last that its host told, from now on too old to be believed.
  std::vector<PoseReport> poses = std::move(report.poses);
  report.begin(authority.step);
  report.host = host;
  report.poses = std::move(poses);
  const std::vector<RobotId>& told = authority.hosts[host].told;
  report.poses.resize(told.size());
  for (std::size_t i = 0; i < told.size(); ++i) {
    report.poses[i].robot = told[i];
    report.poses[i].reported.stale = report.poses[i].reported.known;
    report.poses[i].reported.velocity = {};
  }
  if (authority.step == 0) return;
  for (const RobotId robot : authority.hosts[host].simulated) {
    report.proposals.robots.push_back(robot.value());
  }
  const std::size_t count = report.proposals.robots.size();
  report.proposals.vx_mps.assign(count, 0);
  report.proposals.vy_mps.assign(count, 0);
  report.proposals.wz_radps.assign(count, 0);
}

}  // namespace rave::sim
