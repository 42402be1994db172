// SPDX-License-Identifier: Apache-2.0
// What scenario and people change in a world of several hosts.
#include <algorithm>
#include <utility>

#include "input_notes.hpp"
#include "order_checks.hpp"
#include "rave/math/scalar.hpp"
#include "spec_checks.hpp"
#include "truth_look.hpp"
#include "world_authority_impl.hpp"

namespace rave::sim {

void WorldAuthority::Impl::make_changes(WorldStep& world) {
  // The order of one engine: what was asked since the last step, then obstacles of the scenario,
  // then its other changes. Whether there is room for one can depend on the one before it.
  for (WorldInput& input : asked) {
    const std::uint64_t sequence = input.sequence;
    const Status status = do_input(input, world);
    if (!status) refusals.push_back({sequence, status.error().text()});
  }
  asked.clear();
  take_inputs(world);
  take_over_obstacles(world);
  make_obstacle_changes(world);
  for (; next_change < spec.changes.size() && spec.changes[next_change].step <= step;
       ++next_change) {
    const ScheduledChange& scheduled = spec.changes[next_change];
    // The rest is up to the host of the robot; check_not_mixed() has seen to it that none is of
    // both.
    if (scheduled.changes.empty() || !is_of_body(scheduled.changes.front())) continue;
    const Status status = change_body(scheduled.robot, scheduled.changes, Author::kRun, world);
    if (status) continue;
    refuse(scheduled.robot, status.error());
  }
  conduct(world);
}

/// What conditions and scripts decide comes last, so that hosts can tell it from the rest.
void WorldAuthority::Impl::conduct(WorldStep& world) {
  if (!spec.conductor) return;
  world.last = spec.conductor->ended();
  if (world.last) return;
  conducted.clear();
  spec.conductor->decide(TruthLook(truth, step), conducted);
  for (const ScenarioNote& note : conducted.notes) {
    events.push_back(noted_input(step, RobotId(), note.kind, note.text, Author::kRun, hash));
  }
  for (WorldInput& input : conducted.inputs) {
    const Status status = check_and_do(input, world);
    if (!status) refuse(input.robot, status.error());
  }
}

void WorldAuthority::Impl::make_obstacle_changes(WorldStep& world) {
  for (; next_obstacle < spec.obstacle_changes.size() &&
         spec.obstacle_changes[next_obstacle].step <= step;
       ++next_obstacle) {
    const Status status =
        change_obstacle(spec.obstacle_changes[next_obstacle].change, Author::kRun, world);
    if (status) continue;
    refuse(RobotId(), status.error());
  }
}

/// A change of the scenario that cannot be made.
void WorldAuthority::Impl::refuse(RobotId robot, const Error& why) {
  events.push_back(
      noted_input(step, robot, EventKind::kChangeRefused, why.text(), Author::kRun, hash));
  // All are counted, the first ones are kept: a new manager receives them with the world.
  if (refused_count++ < AuthorityState::kMostRefused) refused.push_back(events.back());
}

Status WorldAuthority::Impl::change_obstacle(const ObstacleChange& change, const Author& author,
                                             WorldStep& world) {
  std::string note;
  const SimTime from{static_cast<std::int64_t>(step) * spec.step.ns};
  RAVE_TRY_ASSIGN(ObstacleChange made, truth.change_obstacle(change, from, note));
  events.push_back(noted_obstacle(step, made, note, author, hash));
  world.obstacles.push_back(std::move(made));
  return {};
}

/// What another authority has decided already.
void WorldAuthority::Impl::take_over_obstacles(WorldStep& world) {
  truth.put_obstacles(adopted, {static_cast<std::int64_t>(step) * spec.step.ns});
  for (ObstacleChange& change : adopted) {
    const Author author{!change.asked.empty(), change.by};
    events.push_back(noted_obstacle(step, change, "", author, hash));
    world.obstacles.push_back(std::move(change));
  }
  adopted.clear();
}

/// What the hosts have been told by now.
void WorldAuthority::Impl::close_obstacles() {
  for (const ObstacleChange& change : last_obstacles) history.add(change);
  last_obstacles.clear();
}

/// What people asked of hosts. By host, so that the order does not depend on which report came
/// first.
void WorldAuthority::Impl::take_inputs(WorldStep& world) {
  for (const HostReport* const report : by_host) {
    for (const WorldInput& given : report->inputs) {
      WorldInput input = given;
      input.sequence = ++inputs;
      world.answers.push_back({report->host, given.sequence, inputs});
      const Status status = check_and_do(input, world);
      if (!status) world.refusals.push_back({inputs, status.error().text()});
    }
  }
}

Status WorldAuthority::Impl::check_and_do(WorldInput& input, WorldStep& world) {
  Status status = input.is<request::Order>() ? check_order(spec, input) : Status();
  return status ? do_input(input, world) : status;
}

Status WorldAuthority::Impl::do_input(WorldInput& input, WorldStep& world) {
  if (const auto* const obstacle = input.as<ObstacleChange>()) {
    return change_obstacle(*obstacle, input.author, world);
  }
  // Of a robot that was placed its host keeps in its record what was asked.
  if (const auto* const there = input.as<request::Place>()) RAVE_TRY(place(input, *there));
  const auto* const change = input.as<Change>();
  if (change != nullptr && is_of_body(change->changes.front())) {
    return change_body(input.robot, change->changes, input.author, world);
  }
  world.inputs.push_back(std::move(input));
  return {};
}

Status WorldAuthority::Impl::change_body(RobotId robot, std::span<const ParameterChange> changes,
                                         const Author& author, WorldStep& world) {
  for (const ParameterChange& change : changes) {
    const Status checked = check_body_change(change);
    if (!checked) return refused_change(spec, robot, "body", checked.error());
  }
  const double before = truth.scale_of(robot);
  const double after = std::get<double>(changes.back().value);
  const Status resized = truth.resize(robot, after);
  if (!resized) return refused_change(spec, robot, "body", resized.error());
  world.resized.push_back({robot, after, author.name});
  events.push_back(
      noted_input(step, robot, EventKind::kChanged, body_change_text(before, after), author, hash));
  return {};
}

/// As in one process, see Engine::Impl::place().
Status WorldAuthority::Impl::place(const WorldInput& input, const request::Place& there) {
  const double yaw_rad = truth.movers[input.robot.value()].X_WR.yaw;
  const Status placed = truth.place(input.robot, ordered_place(there, yaw_rad));
  if (!placed) return refused_order(spec, input, placed.error().code, placed.error().message);
  events.push_back(noted_order(step, input, EventKind::kPlaced, hash));
  return {};
}

Status WorldAuthority::check_place(const WorldInput& input) const {
  const Impl& authority = *impl_;
  RAVE_TRY(check_order(authority.spec, input));
  const auto* const there = input.as<request::Place>();
  if (there == nullptr) return fail(ErrorCode::kInvalidArgument, "the input places no robot");
  const WorldTruth& truth = authority.truth;
  const double yaw_rad = truth.movers[input.robot.value()].X_WR.yaw;
  const Status room = truth.check_place(input.robot, ordered_place(*there, yaw_rad));
  if (room) return {};
  return refused_order(authority.spec, input, room.error().code, room.error().message);
}

namespace {

Status check_change(const EngineSpec& spec, RobotId robot, const Change& change) {
  const std::vector<ParameterChange>& all = change.changes;
  if (all.empty()) return fail(ErrorCode::kInvalidArgument, "nothing to change");
  const auto of_body = std::count_if(all.begin(), all.end(), is_of_body);
  if (of_body == 0 || static_cast<std::size_t>(of_body) == all.size()) return {};
  return fail(ErrorCode::kInvalidArgument,
              "robot `{}`: its body and other parts cannot change in one request while several "
              "hosts share the world; send two requests",
              spec.robots[robot.value()].name);
}

}  // namespace

Result<std::uint64_t> WorldAuthority::ask(WorldInput input) {
  Impl& authority = *impl_;
  if (input.is<request::Order>()) RAVE_TRY(check_order(authority.spec, input));
  if (const auto* const obstacle = input.as<ObstacleChange>()) {
    RAVE_TRY(check_obstacle_change(*obstacle));
  }
  const auto* const change = input.as<Change>();
  if ((input.robot.valid() || change != nullptr) &&
      input.robot.value() >= authority.spec.robots.size()) {
    return fail(ErrorCode::kInvalidArgument, "there is no robot {}", input.robot.value());
  }
  if (change != nullptr) RAVE_TRY(check_change(authority.spec, input.robot, *change));
  input.sequence = ++authority.inputs;
  authority.asked.push_back(std::move(input));
  return authority.inputs;
}

void WorldAuthority::adopt(ObstacleChange change) { impl_->adopted.push_back(std::move(change)); }

Result<ObstacleChange> WorldAuthority::decide(const ObstacleChange& change, SimTime at,
                                              std::string& note) {
  RAVE_TRY_ASSIGN(ObstacleChange made, impl_->truth.change_obstacle(change, at, note));
  impl_->history.add(made);
  return made;
}

Status WorldAuthority::put_obstacles(std::span<const ObstacleChange> changes, SimTime at) {
  AuthorityState state;
  state.obstacle_changes = changes.size();
  state.obstacles.assign(changes.begin(), changes.end());
  RAVE_TRY(check_told_obstacles(impl_->spec, WorldStep(), state));
  static_cast<void>(impl_->truth.restore_obstacles());
  impl_->truth.put_obstacles(changes, at);
  impl_->history = ObstacleHistory(state.obstacles, state.obstacle_changes);
  return {};
}

void WorldAuthority::repeat_schedule() noexcept {
  impl_->next_change = 0;
  impl_->next_obstacle = 0;
}

}  // namespace rave::sim
