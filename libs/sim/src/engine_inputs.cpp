// SPDX-License-Identifier: Apache-2.0
// What is asked of a run between two steps: who carries it out, and what follows for the engine.
#include <algorithm>
#include <utility>

#include "engine_impl.hpp"
#include "order_checks.hpp"
#include "parameter_edit.hpp"
#include "rave/base/check.hpp"
#include "rave/math/scalar.hpp"
#include "spec_checks.hpp"
#include "truth_look.hpp"

namespace rave::sim {

void Engine::Impl::body_changed(RobotId robot) {
  if (past.world) past.world->body_changed(robot);
  if (fusion_world) {
    fusion_world->world.body_changed(robot);
    fusion_world->valid = false;
  }
  // Its guard may still read the old one; the next order makes a new one.
  if (!guard_bodies.empty()) guard_bodies[robot.value()].reset();
  if (!roster.is_local(robot)) return;
  roster.group_of(robot).program.setups[roster.member_of(robot)].robot.radius_m =
      truth.radius_m[robot.value()];
}

void Engine::Impl::obstacle_changed(const ObstacleChange& change) {
  // Where it was and is, they find in the journal.
  if (change.kind != ObstacleChange::Kind::kAdd) return;
  if (past.world) past.world->obstacle_added();
  if (fusion_world) fusion_world->world.obstacle_added();
}

void Engine::Impl::restore_world() {
  if (truth.restore_obstacles()) {
    // Snapshots of the past may show obstacles that are gone; new ones begin with the world of the
    // start.
    past.world.reset();
    if (fusion_world) fusion_world = std::make_unique<FusionWorld>(spec.world);
  }
  for (const RobotId robot : truth.restore_bodies()) body_changed(robot);
}

void Engine::Impl::drivers_changed(RobotId robot, const Arrival& place) {
  const std::uint32_t r = robot.value();
  const RobotType& type = *roster.group_of(robot).type;
  truth.set_reality(robot, type.simulated, place.X_WR);
  body_changed(robot);
  if (host) {
    host->set_type(robot, type);
    // What the other drivers said since the last report is nothing that these can say.
    std::erase_if(host->samples,
                  [robot](const PoseSample& sample) { return sample.robot == robot; });
  }
  reported[r] = {{place.X_WR.x, place.X_WR.y, place.X_WR.yaw, place.variance.variance_xy_m2,
                  place.variance.variance_yaw_rad2},
                 {},
                 place.stamp,
                 true,
                 false};
  // The velocity would otherwise be estimated across the jump between the two pose sources.
  tracks[r].clear();
  tracks[r].add(place.stamp, place.X_WR);
  // Who armed the robot before armed another one.
  robot_guards[r].set_armed(is_armed_at_first(type));
}

void Engine::Impl::drivers_restored(RobotId robot) {
  const RobotType& type = *roster.group_of(robot).type;
  truth.set_reality(robot, type.simulated, spec.robots[robot.value()].X_WR);
  body_changed(robot);
  if (host) host->set_type(robot, type);
}

/// What conditions and scripts decide. With several hosts the authority asks them.
void Engine::Impl::conduct() {
  if (!spec.conductor || spec.conductor->ended()) return;
  conducted.clear();
  spec.conductor->decide(TruthLook(truth, step), conducted);
  for (ScenarioNote& note : conducted.notes) {
    input_log.note(step, RobotId(), note.kind, std::move(note.text), Author::kRun);
  }
  for (const WorldInput& input : conducted.inputs) {
    const Status status = make_input(input);
    if (status) continue;
    input_log.note(step, input.robot, EventKind::kChangeRefused, status.error().text(),
                   Author::kRun);
  }
}

/// Of an engine that is alone.
Status Engine::Impl::make_input(const WorldInput& input) {
  if (input.is_hold()) {
    hold(input);
    return {};
  }
  if (const auto* const obstacle = input.as<ObstacleChange>()) {
    RAVE_TRY(inputs.change_obstacle(step, *obstacle, input.author));
    return {};
  }
  if (const auto* const change = input.as<Change>()) {
    return inputs.change(step, input.robot, change->changes, input.author);
  }
  RAVE_TRY(sim::check_order(spec, input));
  return order(input);
}

void Engine::Impl::hold(const WorldInput& input) {
  if (input.is<request::Stop>()) return inputs.stop(step, input.robot, input.author);
  if (input.is<request::Release>()) return inputs.release(step, input.robot, input.author);
  inputs.arm(step, input.robot, input.author);
}

Status Engine::Impl::order(const WorldInput& input) {
  if (input.is<request::Cancel>()) {
    orders.cancel(step, input);
    return {};
  }
  if (!roster.is_local(input.robot)) {
    return refused_order(spec, input, ErrorCode::kState, "it runs on another host");
  }
  if (const auto* const there = input.as<request::Place>()) return place(input, *there);
  return orders.take(step, input, robot_guards[input.robot.value()].holds(),
                     hand_overs.is_under_way(input.robot));
}

Status Engine::Impl::may_order(const WorldInput& input) const {
  if (input.is<request::Cancel>()) return {};
  if (!roster.is_local(input.robot)) {
    return refused_order(spec, input, ErrorCode::kState, "it runs on another host");
  }
  if (input.is<request::Place>()) return {};
  return orders.check(input, robot_guards[input.robot.value()].holds(),
                      hand_overs.is_under_way(input.robot));
}

Status Engine::Impl::place(const WorldInput& input, const request::Place& there) {
  if (host) {
    return refused_order(spec, input, ErrorCode::kState,
                         "only the authority of the world can place robots");
  }
  const double yaw_rad = truth.movers[input.robot.value()].X_WR.yaw;
  const Status placed = truth.place(input.robot, ordered_place(there, yaw_rad));
  if (!placed) return refused_order(spec, input, placed.error().code, placed.error().message);
  input_log.note_order(step, input, EventKind::kPlaced);
  return {};
}

Status Engine::Impl::check_own(RobotId robot, std::span<const ParameterChange> changes) const {
  const std::string& name = spec.robots[robot.value()].name;
  if (!roster.is_local(robot)) {
    return fail(ErrorCode::kState, "robot `{}` runs on another host", name);
  }
  if (std::none_of(changes.begin(), changes.end(), is_of_body)) return {};
  return fail(ErrorCode::kState, "only the authority can change the body of robot `{}`", name);
}

void Engine::stop(RobotId robot, const Author& author) {
  impl_->inputs.stop(impl_->step, robot, author);
}
void Engine::release(RobotId robot, const Author& author) {
  impl_->inputs.release(impl_->step, robot, author);
}
void Engine::arm(RobotId robot, const Author& author) {
  impl_->inputs.arm(impl_->step, robot, author);
}

bool Engine::stopped(RobotId robot) const noexcept {
  return impl_->robot_guards[robot.value()].holds().stopped;
}
bool Engine::armed(RobotId robot) const noexcept {
  return impl_->robot_guards[robot.value()].holds().armed;
}

std::string Engine::drive_trouble(RobotId robot) const {
  if (!is_local(robot)) return {};
  const std::size_t member = impl_->roster.member_of(robot);
  for (const ActuatorSlots& slots : impl_->roster.group_of(robot).actuators) {
    if (!slots.trouble[member].empty()) {
      return fmt::format("actuator `{}`: {}", slots.spec->name, slots.trouble[member]);
    }
  }
  return {};
}

Status Engine::set_parameters(RobotId robot, std::span<const ParameterChange> changes,
                              const Author& author) {
  RAVE_CHECK(robot.value() < impl_->spec.robots.size());
  if (changes.empty()) return fail(ErrorCode::kInvalidArgument, "nothing to change");
  if (impl_->host) RAVE_TRY(impl_->check_own(robot, changes));
  return impl_->inputs.change(impl_->step, robot, changes, author);
}

Result<ChangedObstacle> Engine::change_obstacle(const ObstacleChange& change,
                                                const Author& author) {
  if (impl_->host) {
    return fail(ErrorCode::kState, "only the authority can change obstacles");
  }
  return impl_->inputs.change_obstacle(impl_->step, change, author);
}

std::string Engine::parameter(RobotId robot, ParameterChange::Part part, std::uint32_t index,
                              std::string_view name) const {
  if (part == ParameterChange::Part::kBody) {
    if (name != "scale") return {};
    return fmt::format("{}", impl_->truth.scale_of(robot));
  }
  if (!is_local(robot)) return {};
  Roster& roster = impl_->roster;
  const auto target =
      parameter_target(roster.group_of(robot), roster.member_of(robot), part, index);
  return target ? present_text(*target, name).value_or(std::string()) : std::string();
}

bool Engine::has_changed_parameters(RobotId robot) const {
  if (!is_local(robot)) return false;
  const RobotGroup& group = impl_->roster.group_of(robot);
  const auto is_changed = [m = impl_->roster.member_of(robot)](const auto& slots) {
    return m < slots.changed.size() && slots.changed[m] != nullptr;
  };
  return is_changed(group.program) || std::ranges::any_of(group.controllers, is_changed) ||
         std::ranges::any_of(group.actuators, is_changed) || impl_->truth.scale_of(robot) != 1;
}

std::uint64_t Engine::inputs_by_hand() const noexcept { return impl_->input_log.by_hand(); }
void Engine::set_world_age(Duration age) noexcept { impl_->world_age = age; }
void Engine::halt() noexcept { impl_->halt(); }

Status Engine::order(const WorldInput& input) {
  RAVE_TRY(sim::check_order(impl_->spec, input));
  return impl_->order(input);
}

Status Engine::check_order(const WorldInput& input) const {
  RAVE_TRY(sim::check_order(impl_->spec, input));
  return impl_->may_order(input);
}

OrderSet Engine::takes(RobotId robot) const noexcept {
  return is_local(robot) ? impl_->orders.takes(robot) : 0;
}

std::string Engine::order_of(RobotId robot) const { return impl_->orders.under_way(robot); }

Status Engine::hand_over(RobotId robot, DriverSet to, const Author& author) {
  RAVE_CHECK(robot.value() < impl_->spec.robots.size());
  return impl_->hand_overs.ask(impl_->step, robot, to, author);
}

std::optional<HandOverState> Engine::hand_over_state(RobotId robot) const {
  const HandOverState* const state = impl_->hand_overs.state(robot);
  return state != nullptr ? std::optional(*state) : std::nullopt;
}

bool Engine::show_reality(RobotId robot, bool simulated) {
  Impl& engine = *impl_;
  const std::uint32_t r = robot.value();
  RAVE_CHECK(r < engine.spec.robots.size() && !engine.roster.is_local(robot));
  RobotSpec& its = engine.spec.robots[r];
  if (engine.spec.types[its.type].simulated == simulated) return true;
  if (!its.twin || engine.spec.types[*its.twin].simulated != simulated) return false;
  std::swap(its.type, *its.twin);
  // set_reality() makes a robot present; whether its host reports it is another matter.
  const bool present = engine.truth.movers[r].present;
  engine.truth.set_reality(robot, simulated, engine.truth.movers[r].X_WR);
  engine.truth.movers[r].present = present;
  engine.body_changed(robot);
  return true;
}

}  // namespace rave::sim
