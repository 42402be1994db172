// SPDX-License-Identifier: Apache-2.0
// The broad phase: moves the robots for which each test of the resolver must end without a hit. The
// bounds are derived in docs/explanation/motion.md.
#include "motion_phase.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave::sim {
namespace {

/// Robots that one thread takes at a time. Part of no result.
constexpr std::size_t kBlock = 256;
/// Two that stay farther apart than this do not touch: the resolver's own limit, and as much again
/// for the rounding of coordinates up to a thousand kilometres.
constexpr double kApart_m = 2 * Resolver::kPassOver_m;
/// A robot that turns farther in one step goes to the resolver, whose bound for a turn ends at a
/// quarter of a revolution.
constexpr double kMostTurn_rad = 1.5;

/// Whether all of the piece's shape lies farther than `reach_m` from p: surely so if one of its
/// edges has it behind. Pieces of discs are not asked for unless they are near.
bool is_beyond(const world::Snapshot& snapshot, const world::ShapePiece& piece, Vec2 p_W,
               double reach_m) noexcept {
  const Vec2* const vertices = snapshot.vertices_W() + piece.first_vertex;
  const Vec2* const normals = snapshot.normals_W() + piece.first_vertex;
  for (std::uint32_t k = 0; k < piece.vertex_count; ++k) {
    // n.(p - v) is a lower bound of the distance from the polygon, near corners a loose one. That
    // only sends some free robots to the resolver.
    if (dot(normals[k], p_W - vertices[k]) > reach_m) return true;
  }
  return false;
}

}  // namespace

void MotionPhase::run(const world::Snapshot& snapshot, double dt_s, const MotionArrays& robots,
                      std::vector<ContactNote>& notes) {
  const std::size_t count = robots.movers.size();
  const std::size_t blocks = (count + kBlock - 1) / kBlock;
  reach_m_.resize(count);
  way_.resize(count);
  block_slack_m_.resize(blocks);
  near_.resize(blocks);
  kept_.assign(blocks, 0);
  listed_slack_m_.resize(blocks);
  const Step step{snapshot, dt_s, robots};
  pool_->for_each_block(blocks, measure_effort_,
                        [this, &step](std::size_t b, unsigned) { measure(step, b); });
  // Two passes, since how far a robot has to look depends on the fastest of all.
  slack_m_ = 0;
  for (const double slack_m : block_slack_m_) slack_m_ = std::max(slack_m_, slack_m);
  moves_m_ = std::max(slack_m_, watch_.look(snapshot));
  pool_->for_each_block(blocks, let_go_effort_,
                        [this, &step](std::size_t b, unsigned) { let_go(step, b); });
  notes.clear();
  resolved_ = 0;
  const auto begin = way_.begin();
  // In the order of ids, on one thread: from here on each robot depends on those before it.
  for (auto it = std::find(begin, way_.end(), kToResolve); it != way_.end();
       it = std::find(it + 1, way_.end(), kToResolve)) {
    resolve(step, static_cast<std::uint32_t>(it - begin), notes);
    ++resolved_;
  }
}

void MotionPhase::measure(const Step& step, std::size_t block) {
  const std::size_t last = std::min((block + 1) * kBlock, reach_m_.size());
  double slack_m = 0;
  for (std::size_t r = block * kBlock; r < last; ++r) {
    const double radius_m = resolver_->radius_m(static_cast<std::uint32_t>(r));
    reach_m_[r] = radius_m;
    if (!step.robots.movers[r].simulated) continue;
    const Twist2& twist = step.robots.proposal[r];
    const double speed_mps = std::sqrt(twist.vx * twist.vx + twist.vy * twist.vy);
    // The chord of an arc is no longer than the arc.
    reach_m_[r] = radius_m + speed_mps * step.dt_s;
    // A turn moves what lies off the body's origin.
    slack_m = std::max(slack_m, (speed_mps + std::abs(twist.wz) * radius_m) * step.dt_s);
  }
  block_slack_m_[block] = slack_m;
}

void MotionPhase::let_go(const Step& step, std::size_t block) {
  const NearLists* const lists = find_near(step, block);
  const std::size_t last = std::min((block + 1) * kBlock, way_.size());
  for (std::size_t r = block * kBlock; r < last; ++r) {
    way_[r] = try_to_go(step, static_cast<std::uint32_t>(r), lists);
  }
}

const NearLists* MotionPhase::find_near(const Step& step, std::size_t block) {
  constexpr double kMostMargin_m = 0.5;
  const world::Snapshot& world = step.snapshot;
  const double margin_m = NearLists::margin_for(moves_m_, kMostMargin_m);
  if (margin_m == 0) return nullptr;
  const auto first = static_cast<std::uint32_t>(block * kBlock);
  const std::size_t count = std::min(kBlock, way_.size() - first);
  std::array<Vec2, kBlock> places_W;
  for (std::uint32_t i = 0; i < count; ++i) {
    // From the snapshot, not from the movers: other blocks may be moving theirs.
    places_W[i] = world.robot(RobotId(first + i)).X_WR.position();
  }
  NearLists& lists = near_[block];
  // What a robot has to look at lies within its radius, twice the slack, and what is always added.
  const double more_m = std::max(0.0, 2 * (slack_m_ - listed_slack_m_[block]));
  kept_[block] = lists.hold(world, {places_W.data(), count}, more_m) ? 1 : 0;
  if (kept_[block] != 0) return &lists;
  lists.begin(world, {places_W.data(), count}, margin_m);
  listed_slack_m_[block] = slack_m_;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t robot = first + i;
    const bool asks = step.robots.movers[robot].simulated;
    const double reach_m = look_m(resolver_->radius_m(robot) + slack_m_) + margin_m;
    // Numbers of pieces stay valid for as long as the lists hold, because a new index of obstacles
    // begins a new generation.
    if (asks) {
      world.for_each_standing_near(places_W[i], reach_m,
                                   [&](const world::ShapePiece& piece) { lists.add(piece.index); });
    }
    lists.end_list();
    if (asks) {
      world.for_each_robot_near(places_W[i], reach_m, [&](const world::ShapePiece& piece) {
        const std::uint32_t other = piece.body - resolver_->obstacle_count();
        if (other != robot) lists.add(other);
      });
    }
    lists.end_list();
  }
  return &lists;
}

MotionPhase::Way MotionPhase::try_to_go(const Step& step, std::uint32_t robot,
                                        const NearLists* lists) const {
  Mover& mover = step.robots.movers[robot];
  if (!mover.simulated) return kStands;
  step.robots.touch[robot] = {};
  const Twist2& twist = step.robots.proposal[robot];
  // A robot that stands meets nothing by its own motion; a robot that comes near stops at it.
  if (twist == Twist2{}) {
    step.robots.velocity[robot] = {};
    step.robots.limited[robot] = 0;
    return kStands;
  }
  const bool free = lists != nullptr ? is_free(step, robot, *lists) : is_free(step, robot);
  if (!free) return kToResolve;
  // No other thread reads or writes this mover here: others are read from the snapshot.
  mover.X_WR = integrate(mover.X_WR, step.snapshot.turn_WR(RobotId(robot)), twist, step.dt_s);
  step.robots.velocity[robot] = twist;
  step.robots.limited[robot] = 0;
  return kAhead;
}

double MotionPhase::standing_reach_m(const Step& step, std::uint32_t robot) const {
  const double turn_rad = std::abs(step.robots.proposal[robot].wz * step.dt_s);
  // What the resolver's time of impact allows for the turn of a vertex at the rim.
  const double turn_m = resolver_->radius_m(robot) * turn_rad * (1 + 0.5 * turn_rad);
  return reach_m_[robot] + turn_m + kApart_m;
}

double MotionPhase::look_m(double reach_m) const noexcept {
  return reach_m + slack_m_ + Resolver::kLookAround_m + kApart_m;
}

bool MotionPhase::may_meet(const Step& step, std::uint32_t robot, std::uint32_t other) const {
  const Vec2 apart = step.snapshot.robot(RobotId(other)).X_WR.position() -
                     step.robots.movers[robot].X_WR.position();
  const double reach_m = reach_m_[robot] + reach_m_[other] + kApart_m;
  // Not `<=`: a place that is not a number counts as near.
  return !(squared_norm(apart) > reach_m * reach_m);
}

bool MotionPhase::is_free(const Step& step, std::uint32_t robot) const {
  const Vec2 p_WR = step.robots.movers[robot].X_WR.position();
  const bool spins = std::abs(step.robots.proposal[robot].wz * step.dt_s) > kMostTurn_rad;
  const double reach_m = standing_reach_m(step, robot);
  bool free = true;
  step.snapshot.for_each_standing_near(p_WR, reach_m, [&](const world::ShapePiece& piece) {
    free = free && !spins && is_beyond(step.snapshot, piece, p_WR, reach_m);
  });
  if (!free) return false;
  step.snapshot.for_each_robot_near(
      p_WR, look_m(reach_m_[robot]), [&](const world::ShapePiece& piece) {
        const std::uint32_t other = piece.body - resolver_->obstacle_count();
        free = free && (other == robot || !may_meet(step, robot, other));
      });
  return free;
}

bool MotionPhase::is_free(const Step& step, std::uint32_t robot, const NearLists& lists) const {
  // The lists do not reach as far as one that spins may need.
  if (std::abs(step.robots.proposal[robot].wz * step.dt_s) > kMostTurn_rad) {
    return is_free(step, robot);
  }
  const std::size_t asker = robot % kBlock;
  const Vec2 p_WR = step.robots.movers[robot].X_WR.position();
  const double reach_m = standing_reach_m(step, robot);
  for (const std::uint32_t index : lists.first(asker)) {
    const world::ShapePiece& piece = step.snapshot.pieces()[index];
    const double near_m = reach_m + static_cast<double>(piece.radius_m);
    if (squared_norm(piece.centre_W - p_WR) <= near_m * near_m &&
        !is_beyond(step.snapshot, piece, p_WR, reach_m)) {
      return false;
    }
  }
  for (const std::uint32_t other : lists.second(asker)) {
    if (may_meet(step, robot, other)) return false;
  }
  return true;
}

void MotionPhase::resolve(const Step& step, std::uint32_t robot, std::vector<ContactNote>& notes) {
  Mover& mover = step.robots.movers[robot];
  const Pose2 X_before = mover.X_WR;
  const Twist2& twist = step.robots.proposal[robot];
  const Pose2 X_wanted = integrate(X_before, twist, step.dt_s);
  const std::size_t first = notes.size();
  // The resolver follows the chord of the arc. Only a robot that meets nothing gets the end of the
  // exact arc.
  resolver_->move(robot, {X_wanted.x - X_before.x, X_wanted.y - X_before.y, twist.wz * step.dt_s},
                  step.snapshot, slack_m_, step.robots.movers, notes, way_);
  const bool limited = notes.size() > first;
  step.robots.limited[robot] = limited ? 1 : 0;
  if (limited) {
    // advance() adds angles. The actuator gets the velocity that leads along the arc
    // from the old pose to the new one.
    mover.X_WR.yaw = wrap_angle(mover.X_WR.yaw);
    step.robots.velocity[robot] = twist_between(X_before, mover.X_WR, step.dt_s);
  } else {
    mover.X_WR = X_wanted;
    step.robots.velocity[robot] = twist;
  }
}

}  // namespace rave::sim
