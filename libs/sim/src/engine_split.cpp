// SPDX-License-Identifier: Apache-2.0
// A step of one of several hosts, cut in two: propose() ends a step and reads the samples of the
// next one, apply() begins that with the world of the authority. See docs/explanation/lock-step.md.
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "engine_impl.hpp"
#include "message_checks.hpp"
#include "radio.hpp"

namespace rave::sim {
namespace {

/// What of a change of an obstacle has not been made yet in this world; ids of new ones ascend.
std::optional<ObstacleChange> left_to_do(const world::WorldModel& world,
                                         const ObstacleChange& change) {
  using Kind = ObstacleChange::Kind;
  const world::Obstacle* const obstacle = world.obstacle(change.id.value());
  if (obstacle == nullptr) return change;
  if (obstacle->removed) return std::nullopt;
  if (change.kind == Kind::kRemove) return change;
  const Pose2& X_WB = obstacle->X_WB;
  // An exact comparison: one is a copy of the other, never computed again.
  const bool there =
      X_WB.x == change.X_WB.x && X_WB.y == change.X_WB.y && X_WB.yaw == change.X_WB.yaw;
  if (there) return std::nullopt;
  ObstacleChange move;
  move.kind = Kind::kMove;
  move.id = change.id;
  move.name = change.name;
  move.X_WB = change.X_WB;
  return move;
}

}  // namespace

Status Engine::propose(HostReport& report) {
  Impl& engine = *impl_;
  if (!engine.host) {
    return fail(ErrorCode::kState, "runs all robots: expected step() instead of propose()");
  }
  if (engine.host->proposed) {
    return fail(ErrorCode::kState, "step {} has been proposed: apply() comes next", engine.step);
  }
  PhaseTimer phase(engine.spec.phase_clock, engine.phase_times);
  Status status = engine.propose(report, phase);
  if (status) return {};
  // The authority must learn of the failure, or it would wait for this host until its timeout.
  report.begin(engine.step);
  report.state = HostState::kFailed;
  report.text = status.error().text();
  return status;
}

Status Engine::Impl::propose(HostReport& report, PhaseTimer& phase) {
  if (host->begun) {
    // Inputs since the step began are events of it.
    input_log.add_to(events);
    // The world of this step has come with apply(). While this host computes, the authority waits
    // for the reports of all.
    work(phase);
    publish();
    phase.ends(Phase::kPublish);
    host->begun = false;
    host->hash = hash;
    host->events.swap(events);
    events.clear();
    ++step;
    if (spec.on_step_done) spec.on_step_done();
  }
  // What hardware says of the next step does not depend on where the authority lets robots go, and
  // the authority needs to know where the real ones are.
  now = step_time(step);
  if (!hand_overs.empty()) hand_overs.advance(step);
  forget_past();
  RAVE_TRY(ingest_sensors(false));
  pool.for_each_block(roster.blocks.size(), refresh_effort, [this](std::size_t b, unsigned w) {
    if (roster.groups[roster.blocks[b].group].type->pose_from)
      refresh_told(roster.blocks[b], workers[w]);
  });
  phase.ends(Phase::kIngest);
  host->proposed = true;
  fill_report(report);
  phase.ends(Phase::kPublish);
  return {};
}

void Engine::Impl::fill_report(HostReport& report) {
  report.begin(step);
  // The first report opens the run: no step has been computed, so no host has proposed anything.
  if (step > 0) {
    Proposals& all = report.proposals;
    for (const RobotId robot : host->simulated) {
      const Twist2& twist = truth.proposal[robot.value()];
      all.robots.push_back(robot.value());
      all.vx_mps.push_back(twist.vx);
      all.vy_mps.push_back(twist.vy);
      all.wz_radps.push_back(twist.wz);
    }
  }
  for (const RobotId robot : host->told) report.poses.push_back({robot, reported[robot.value()]});
  // Swapped, so that both keep their room.
  report.sent.packets.swap(host->sent.packets);
  report.sent.bytes.swap(host->sent.bytes);
  host->sent.clear();
  report.samples.swap(host->samples);
  host->samples.clear();
  // By robot and stamp, so that the bits of the report do not depend on the order of the groups.
  std::sort(report.samples.begin(), report.samples.end(), [](const auto& a, const auto& b) {
    return std::tie(a.robot, a.stamp) < std::tie(b.robot, b.stamp);
  });
  report.refusals.swap(host->refusals);
  host->refusals.clear();
}

Status Engine::apply(const WorldStep& world) {
  Impl& engine = *impl_;
  if (!engine.host) {
    return fail(ErrorCode::kState, "runs all robots: expected step() instead of apply()");
  }
  if (!engine.host->proposed) {
    return fail(ErrorCode::kState, "step {} has begun: propose() comes next", engine.step);
  }
  RAVE_TRY(engine.check(world));
  PhaseTimer phase(engine.spec.phase_clock, engine.phase_times);
  return engine.apply(world, true, phase);
}

Status Engine::join(const WorldStep& world, const AuthorityState& state) {
  Impl& engine = *impl_;
  const bool later = engine.host && engine.host->proposed && world.step > engine.step;
  if (!later) return apply(world);
  const bool missed = state.obstacle_changes != engine.host->obstacle_changes;
  RAVE_TRY(check_taken_over(engine.spec, world, state, missed));
  PhaseTimer phase(engine.spec.phase_clock, engine.phase_times);
  engine.step = world.step;
  engine.now = engine.step_time(world.step);
  // The time that this host was not there is none in which a hand-over came to nothing.
  engine.hand_overs.skip_to(world.step);
  RAVE_TRY(engine.catch_up(world, state));
  RAVE_TRY(engine.take_newer_samples());
  // No host has sent the authority the data of that time, and it does not need them any more.
  engine.host->samples.clear();
  return engine.apply(world, false, phase);
}

/// Makes the changes that this host was not there for; those of the world itself come with it.
Status Engine::Impl::catch_up(const WorldStep& world, const AuthorityState& state) {
  if (host->obstacle_changes != state.obstacle_changes) {
    std::vector<ObstacleChange> missed;
    for (const ObstacleChange& change : state.obstacles) {
      const auto left = left_to_do(spec.world, change);
      if (left) missed.push_back(*left);
    }
    put_obstacles(missed);
    host->obstacle_changes = state.obstacle_changes;
  }
  for (const ResizedRobot& resized : state.scales) {
    if (truth.scale_of(resized.robot) == resized.scale) continue;
    RAVE_TRY(inputs.resize(resized));
  }
  return check_world_step(spec, world);
}

/// What hardware has said since the step was proposed.
Status Engine::Impl::take_newer_samples() {
  RAVE_TRY(ingest_sensors(false));
  for (const Block& block : roster.blocks) {
    if (roster.groups[block.group].type->pose_from) refresh_told(block, workers[0]);
  }
  return {};
}

Status Engine::Impl::check(const WorldStep& world) const {
  if (world.step != step) {
    return fail(ErrorCode::kInvalidArgument, "the world is for step {}, but step {} is next",
                world.step, step);
  }
  return check_world_step(spec, world);
}

Status Engine::Impl::apply(const WorldStep& world, bool was_there, PhaseTimer& phase) {
  host->proposed = false;
  host->begun = true;
  past.valid = false;
  if (was_there && step > 0 && !radio->empty()) {
    // Who hears a message is decided in the world in which it was sent.
    const RadioMoment moment{
        step - 1, step_time(step - 1), host->reported_at_sending, &truth.snapshot, &hash, &events};
    // This comes before the changes: truth.snapshot still shows the step in which the messages were
    // sent.
    RAVE_TRY(radio->receive(moment, world.sent));
  }
  phase.ends(Phase::kRadio);
  RAVE_TRY(make_changes(world));
  // Bodies and obstacles first, since the poses of the authority were found with the new ones.
  adopt(world);
  if (spec.own_authority && was_there) RAVE_TRY(take_newer_samples());
  show_world();
  if (fusion_world) RAVE_TRY(ingest_sensors(true));
  phase.ends(Phase::kIngest);
  return {};
}

Status Engine::Impl::make_changes(const WorldStep& world) {
  for (const ResizedRobot& resized : world.resized) {
    RAVE_TRY(inputs.resize(resized));
  }
  put_obstacles(world.obstacles);
  // As in one process: what people asked for, what the scenario has for this step, and then what
  // its conditions have decided, which is last in the list.
  const auto decided = std::ranges::find_if(
      world.inputs, [](const WorldInput& input) { return !input.author.by_hand; });
  std::for_each(world.inputs.begin(), decided, [this](const auto& input) { do_input(input); });
  inputs.make_scheduled_here(step);
  std::for_each(decided, world.inputs.end(), [this](const auto& input) { do_input(input); });
  return {};
}

void Engine::Impl::put_obstacles(std::span<const ObstacleChange> changes) {
  if (changes.empty()) return;
  truth.put_obstacles(changes, step_time(step),
                      [this](const ObstacleChange& change) { obstacle_changed(change); });
  host->obstacle_changes += changes.size();
}

void Engine::Impl::do_input(const WorldInput& input) {
  if (input.is_hold()) return hold(input);
  // The authority has done these.
  if (input.is<ObstacleChange>() || input.is<request::Place>()) return;
  if (input.robot.valid() && !roster.is_local(input.robot)) return;
  const auto* const change = input.as<Change>();
  const Status status = change != nullptr
                            ? inputs.change(step, input.robot, change->changes, input.author)
                            : order(input);
  if (status) return;
  if (!input.author.by_hand) {
    return input_log.note(step, input.robot, EventKind::kChangeRefused, status.error().text(),
                          Author::kRun);
  }
  // The authority has accepted the request for all, and only this host knows that it cannot be
  // done. The refusal reaches the authority with the next report.
  host->refusals.push_back({input.sequence, status.error().text()});
}

void Engine::Impl::adopt(const WorldStep& world) {
  truth.adopt_robots(world);
  // Reported as in a run of one process: before robots are pushed out of another's way.
  for (std::uint32_t r = 0; r < truth.movers.size(); ++r) {
    if (!spec.types[spec.robots[r].type].pose_from) refresh_true(r);
  }
  truth.adopt_contacts(world);
  for (const PoseReport& pose : world.poses) {
    if (!roster.is_local(pose.robot)) reported[pose.robot.value()] = pose.reported;
  }
  for (const PoseSample& sample : world.samples) {
    if (!roster.is_local(sample.robot)) tracks[sample.robot.value()].add(sample.stamp, sample.X_WR);
  }
}

}  // namespace rave::sim
