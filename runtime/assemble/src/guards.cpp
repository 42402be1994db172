// SPDX-License-Identifier: Apache-2.0
#include "guards.hpp"

#include <algorithm>
#include <cmath>

#include "rave/assemble/parameter_key.hpp"
#include "rave/math/decompose.hpp"
#include "rave/math/scalar.hpp"

namespace rave::runtime {
namespace {

sim::WorldLostPolicy policy_of(config::WorldLost policy) {
  if (policy == config::WorldLost::kSlow) return sim::WorldLostPolicy::kSlow;
  return policy == config::WorldLost::kIgnore ? sim::WorldLostPolicy::kIgnore
                                              : sim::WorldLostPolicy::kStop;
}

}  // namespace

Result<std::optional<sim::GuardSpec>> guard_spec(const config::RobotGroup& group) {
  if (!group.robot.guard) return std::nullopt;
  const config::GuardFile& file = *group.robot.guard;
  sim::GuardSpec spec;
  spec.arm = file.arm;
  // Limits that are not in the file keep the value of GuardSpec that means "no limit".
  if (file.max_speed_mps) spec.max_speed_mps = *file.max_speed_mps;
  if (file.max_turn_dps) spec.max_turn_radps = deg_to_rad(*file.max_turn_dps);
  if (file.separation_m) spec.separation_m = *file.separation_m;
  spec.world_lost = policy_of(file.world_lost);
  spec.world_timeout_s = file.world_timeout_s;
  spec.slow_speed_mps = file.slow_speed_mps;
  spec.deceleration_mps2 = file.deceleration_mps2;
  spec.reaction_s = file.reaction_s;
  spec.watchdog_s = file.watchdog_s;
  spec.frozen_s = file.frozen_s;
  spec.must_see_rad = deg_to_rad(file.must_see_deg);
  if (!file.fence_m) return spec;
  for (const auto& [x_m, y_m] : file.fence_m->value) spec.fence_W.push_back({x_m, y_m});
  // The pieces are not used; their existence shows that the fence encloses an area.
  const auto pieces = decompose(spec.fence_W);
  if (!pieces) {
    return fail_at(file.fence_m->where, ErrorCode::kInvalidArgument, "`fence_m` of `{}`: {}",
                   group.name.value, pieces.error().message);
  }
  return spec;
}

Status add_changes(const config::ExpandedScenario& scenario, sim::EngineSpec& spec) {
  const double step_s = scenario.scenario.step_s.value;
  for (const config::ChangeFile& file : scenario.scenario.changes) {
    if (!file.is_scheduled() || !file.robot || !file.set) continue;
    for (const std::size_t r : config::robots_named(scenario, file.robot->value)) {
      sim::ScheduledChange change;
      // `at_s` is a multiple of the step, as the expansion has checked; rounding removes the error
      // of the division.
      change.step = static_cast<std::uint64_t>(std::llround(**file.at_s / step_s));
      change.robot = RobotId(static_cast<std::uint32_t>(r));
      for (std::size_t i = 0; i < file.set->size(); ++i) {
        // The values are read now, so a mistake is reported before the run begins and not when the
        // change is due.
        RAVE_TRY_ASSIGN(auto parsed, parse_change(spec.types[spec.robots[r].type], file.set->key(i),
                                                  file.set->child(i)));
        change.changes.push_back(std::move(parsed));
      }
      spec.changes.push_back(std::move(change));
    }
  }
  // Stable, so that changes of one step keep the order of the file.
  std::stable_sort(spec.changes.begin(), spec.changes.end(),
                   [](const auto& a, const auto& b) { return a.step < b.step; });
  return {};
}

}  // namespace rave::runtime
