// SPDX-License-Identifier: Apache-2.0
// The true state of the world, which an engine alone has, or the authority of several hosts: poses,
// contacts, bodies. It calls the resolver and makes the snapshot.
#include "world_truth.hpp"

#include <algorithm>
#include <bit>
#include <tuple>

#include "rave/math/transform.hpp"
#include "rave/sim/authority_state.hpp"
#include "rave/world/touching.hpp"

namespace rave::sim {

WorldTruth::WorldTruth(EngineSpec& s, ThreadPool& p)
    : spec(s), pool(p), snapshot(s.world), resolver(s.world) {
  for (const world::Body& body : spec.world.robots) radius_m.push_back(body.radius_m());
}

void WorldTruth::begin() {
  const std::size_t count = spec.robots.size();
  slack_m_ = 0;
  notes.clear();
  movers.resize(count);
  velocity.assign(count, Twist2{});
  proposal.assign(count, Twist2{});
  limited.assign(count, 0);
  touch.assign(count, TouchState{});
  touching_before_.assign(count, 0);
  pinned_before_.assign(count, 0);
  for (std::uint32_t r = 0; r < count; ++r) {
    const RobotType& type = spec.types[spec.robots[r].type];
    // A real robot is not in the world before its first pose.
    movers[r] = {
        .X_WR = spec.robots[r].X_WR, .simulated = type.simulated, .present = type.simulated};
    snapshot.set_robot(RobotId(r), {movers[r].X_WR, {}, movers[r].present});
    snapshot.set_touch(RobotId(r), {});
  }
  find_real();
  snapshot.set_time({});
  snapshot.rebuild();
}

void WorldTruth::find_real() {
  real_.clear();
  for (std::uint32_t r = 0; r < movers.size(); ++r) {
    if (!movers[r].simulated) real_.push_back(r);
  }
}

void WorldTruth::make_way() {
  notes.clear();
  bool any = false;
  for (const std::uint32_t r : real_) {
    any = any || movers[r].present;
    snapshot.set_robot(RobotId(r), {movers[r].X_WR, {}, movers[r].present});
  }
  if (!any) return;
  // Real robots may have jumped (a first pose, the end of a gap): the broad phase must know.
  snapshot.rebuild();
  for (const std::uint32_t r : real_) {
    if (!movers[r].present) continue;
    // The snapshot is not built again after each push; it is behind by so much more.
    slack_m_ += resolver.make_way(r, snapshot, slack_m_, movers, notes);
  }
}

void WorldTruth::note_contacts(std::uint64_t step, std::vector<Event>& events) {
  // Contacts: of simulated robots those of the last motion and of making way; of real robots those
  // that their place shows.
  for (const ContactNote& contact : notes) {
    touch[contact.robot] = {true, contact.direction_W};
    if (contact.pinned && pinned_before_[contact.robot] == 0) {
      events.push_back({step, RobotId(contact.robot), EventKind::kPinned, contact.other,
                        std::string(kPinnedText)});
    }
  }
  // An event for the beginning of a pin, none while it lasts.
  std::fill(pinned_before_.begin(), pinned_before_.end(), std::uint8_t{0});
  for (const ContactNote& contact : notes) {
    if (contact.pinned) pinned_before_[contact.robot] = 1;
  }
  // Real robots are where they were reported and keep no skin.
  constexpr double kTouch_m = 1e-3;
  for (const std::uint32_t r : real_) {
    if (!movers[r].present) continue;
    const std::size_t first = notes.size();
    resolver.probe(r, snapshot, slack_m_, kTouch_m, movers, notes);
    touch[r] = notes.size() > first ? TouchState{true, notes.back().direction_W} : TouchState{};
  }
  for (const ContactNote& contact : notes) {
    std::uint8_t& before = touching_before_[contact.robot];
    if (before == 0) {
      events.push_back({step, RobotId(contact.robot), EventKind::kContact, contact.other, ""});
      before = 1;
    }
  }
}

void WorldTruth::show(SimTime now) {
  snapshot.set_time(now);
  block_moves_m_.resize(robot_blocks());
  pool.for_each_block(robot_blocks(), place_effort_, [this](std::size_t b, unsigned) {
    block_moves_m_[b] = place_block(first_of_block(b), first_of_block(b + 1));
  });
  double farthest_m = 0;
  for (const double block_m : block_moves_m_) farthest_m = std::max(farthest_m, block_m);
  snapshot.index_robots(farthest_m);
  // From here on the snapshot shows where all robots are.
  slack_m_ = 0;
}

void WorldTruth::take_over(SimTime now, std::span<const RobotId> pinned) {
  std::fill(pinned_before_.begin(), pinned_before_.end(), std::uint8_t{0});
  for (const RobotId robot : pinned) pinned_before_[robot.value()] = 1;
  notes.clear();
  // Robots are anywhere: nothing that was known of the places before helps.
  for (std::uint32_t r = 0; r < movers.size(); ++r) {
    snapshot.set_robot(RobotId(r), {movers[r].X_WR, {}, movers[r].present});
  }
  snapshot.rebuild();
  show(now);
}

void WorldTruth::adopt_robots(const WorldStep& world) {
  for (std::uint32_t r = 0; r < movers.size(); ++r) {
    movers[r].X_WR = {world.x_m[r], world.y_m[r], world.yaw_rad[r]};
    movers[r].present = (world.flags[r] & WorldStep::kPresent) != 0;
    velocity[r] = {world.vx_mps[r], world.vy_mps[r], world.wz_radps[r]};
    limited[r] = (world.flags[r] & WorldStep::kLimited) != 0 ? 1 : 0;
    // Touching robots are few, so only these are in the message; all others touch nothing.
    touch[r] = {};
  }
}

void WorldTruth::adopt_contacts(const WorldStep& world) {
  for (const PushedRobot& pushed : world.pushed) movers[pushed.robot.value()].X_WR = pushed.X_WR;
  for (const TouchPoint& point : world.touches) {
    touch[point.robot.value()] = {true, point.direction_W};
  }
}

std::vector<RobotId> WorldTruth::pinned() const {
  std::vector<RobotId> robots;
  for (std::uint32_t r = 0; r < pinned_before_.size(); ++r) {
    if (pinned_before_[r] != 0) robots.emplace_back(r);
  }
  return robots;
}

double WorldTruth::place_block(std::uint32_t first, std::uint32_t last) {
  for (std::uint32_t r = first; r < last; ++r) {
    const RobotId robot(r);
    // Who goes straight on keeps what was reckoned for the last step.
    const double before_rad = snapshot.robot(robot).X_WR.yaw;
    const bool turned = std::bit_cast<std::uint64_t>(movers[r].X_WR.yaw) !=
                        std::bit_cast<std::uint64_t>(before_rad);
    // Compared bit by bit: of -0 and 0 the sine differs in its sign.
    const SinCos turn = turned ? sincos(movers[r].X_WR.yaw) : snapshot.turn_WR(robot);
    const Vec2 over_ground = rotate(turn, {velocity[r].vx, velocity[r].vy});
    snapshot.set_robot(
        robot, {movers[r].X_WR, {over_ground.x, over_ground.y, velocity[r].wz}, movers[r].present},
        turn);
    touching_before_[r] = touch[r].touching ? 1 : 0;
    snapshot.set_touch(robot, touch[r]);
  }
  return snapshot.place_robots(first, last);
}

void WorldTruth::resolve(std::uint64_t step, std::vector<Event>& events) {
  motion.run(snapshot, spec.step.seconds(), {movers, proposal, velocity, limited, touch}, notes);
  slack_m_ = motion.slack_m();
  for (const ContactNote& contact : notes) {
    touch[contact.robot] = {true, contact.direction_W};
    if (!spec.world.is_robot(contact.other.value())) continue;
    const std::size_t other = contact.other.value() - spec.world.obstacles.size();
    // The one that was run into touches, too. Real robots are probed by note_contacts().
    if (movers[other].simulated) touch[other] = {true, -contact.direction_W};
  }
  for (const ContactNote& contact : notes) {
    if (touching_before_[contact.robot] != 0) continue;
    touching_before_[contact.robot] = 1;
    events.push_back({step, RobotId(contact.robot), EventKind::kContact, contact.other, ""});
  }
}

RunHash WorldTruth::hash_poses(std::uint64_t step) {
  block_hash_.assign(robot_blocks(), RunHash());
  pool.for_each_block(robot_blocks(), hash_effort_, [this, step](std::size_t b, unsigned) {
    hash_block(step, first_of_block(b), first_of_block(b + 1), block_hash_[b]);
  });
  RunHash sum;
  for (const RunHash block : block_hash_) sum.merge(block);
  return sum;
}

void WorldTruth::hash_block(std::uint64_t step, std::uint32_t first, std::uint32_t last,
                            RunHash& sum) const {
  RunHash own;  // kept off the memory that other threads write to
  for (std::uint32_t r = first; r < last; ++r) {
    if (!movers[r].present) continue;
    const Pose2& X_WR = movers[r].X_WR;
    const Twist2& twist = velocity[r];
    const double values[] = {
        X_WR.x, X_WR.y, X_WR.yaw, twist.vx, twist.vy, twist.wz, touch[r].touching ? 1.0 : 0.0};
    ItemHash item(step, r, HashChannel::kPose, 0);
    item.add_bytes(std::as_bytes(std::span(values)));
    own.add(item);
  }
  sum = own;
}

// From the original and not from the present body, so that rounding does not add up over many
// changes.
Result<world::Body> WorldTruth::body_at(RobotId robot, double scale) const {
  const auto original = original_bodies_.find(robot.value());
  return world::scaled(
      original != original_bodies_.end() ? original->second : spec.world.robots[robot.value()],
      scale);
}

Status WorldTruth::resize(RobotId robot, double scale) {
  if (!movers[robot.value()].simulated) {
    return fail(ErrorCode::kInvalidArgument, "a real body cannot change its size");
  }
  RAVE_TRY_ASSIGN(const world::Body body, body_at(robot, scale));
  // put_scale() is separate, because hosts take over what the authority has checked.
  RAVE_TRY(check_room(robot, body, scale));
  return put_scale(robot, scale);
}

Status WorldTruth::check_room(RobotId robot, const world::Body& body, double scale) const {
  const std::uint32_t r = robot.value();
  const auto own = static_cast<std::uint32_t>(spec.world.obstacles.size()) + r;
  for (std::uint32_t other = 0; other < spec.world.body_count(); ++other) {
    const std::uint32_t other_robot = other - (own - r);
    const world::Obstacle* const obstacle = spec.world.obstacle(other);
    const bool is_robot = obstacle == nullptr;
    if (other == own || (is_robot ? !movers[other_robot].present : obstacle->removed)) continue;
    const Pose2 X_WB = is_robot ? movers[other_robot].X_WR : obstacle->X_WB;
    const world::Body& theirs = spec.world.body(other);
    const double gap_m = world::separation(body, movers[r].X_WR, theirs, X_WB).distance_m;
    if (gap_m >= kApart_m) continue;
    const double before_m =
        world::separation(spec.world.robots[r], movers[r].X_WR, theirs, X_WB).distance_m;
    // An overlap that was there before, as in a faulty scenario, may stay or shrink.
    if (gap_m >= before_m) continue;
    return fail(ErrorCode::kInvalidArgument, "with `scale` {} it would overlap `{}`", scale,
                theirs.name.empty() && is_robot ? spec.robots[other_robot].name : theirs.name);
  }
  return {};
}

Status WorldTruth::put_scale(RobotId robot, double scale) {
  const std::uint32_t r = robot.value();
  RAVE_TRY_ASSIGN(const world::Body body, body_at(robot, scale));
  original_bodies_.try_emplace(r, spec.world.robots[r]);
  scales_[r] = scale;
  put_body(robot, body);
  return {};
}

void WorldTruth::put_body(RobotId robot, const world::Body& body) {
  const std::uint32_t r = robot.value();
  spec.world.robots[r] = body;
  radius_m[r] = body.radius_m();
  resolver.body_changed(r);
  snapshot.body_changed(robot);
}

void WorldTruth::set_reality(RobotId robot, bool simulated, const Pose2& X_WR) {
  const std::uint32_t r = robot.value();
  const Layer layer = simulated ? Layer::kSimulatedRobots : Layer::kRealRobots;
  movers[r] = {.X_WR = X_WR, .simulated = simulated, .present = true};
  find_real();
  velocity[r] = {};
  proposal[r] = {};
  limited[r] = 0;
  world::Body body = spec.world.robots[r];
  body.layer = layer;
  put_body(robot, body);
  const auto original = original_bodies_.find(r);
  // A later reset restores the body that is kept here, and its layer must be the present one.
  if (original != original_bodies_.end()) original->second.layer = layer;
}

double WorldTruth::scale_of(RobotId robot) const {
  const auto scale = scales_.find(robot.value());
  return scale == scales_.end() ? 1.0 : scale->second;
}

std::vector<RobotId> WorldTruth::restore_bodies() {
  std::vector<RobotId> changed;
  for (const auto& [r, body] : original_bodies_) {
    put_body(RobotId(r), body);
    changed.emplace_back(r);
  }
  original_bodies_.clear();
  scales_.clear();
  return changed;
}

void finish_events(std::uint64_t step, std::vector<Event>& events, RunHash& hash) {
  // Which thread noted an event is chance; its robot, kind and text are not.
  std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
    return std::tie(a.robot, a.kind, a.other, a.text) < std::tie(b.robot, b.kind, b.other, b.text);
  });
  for (const Event& event : events) {
    ItemHash item(step, event.robot.value(), HashChannel::kEvent,
                  static_cast<std::uint32_t>(event.kind));
    item.add(std::uint64_t{event.other.value()});
    hash.add(item);
  }
}

}  // namespace rave::sim
