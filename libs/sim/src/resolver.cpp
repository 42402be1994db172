// SPDX-License-Identifier: Apache-2.0
// Motion with contacts, one robot after the other: move until a hit, slide along it, push out of
// real robots. See docs/explanation/motion.md.
#include "resolver.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/scalar.hpp"

namespace rave::sim {
namespace {

constexpr ImpactLimits kLimits;
constexpr int kMaxSlides = 4;
constexpr int kMaxPushes = 8;
/// Deeper than this after all pushes is worth telling.
constexpr double kPinnedDepth_m = 1e-3;

Motion2 scaled(const Motion2& motion, double s) noexcept {
  return {s * motion.dx, s * motion.dy, s * motion.dyaw};
}

}  // namespace

Resolver::Resolver(const world::WorldModel& model) : model_(&model) {
  for (const world::Obstacle& obstacle : model.obstacles) {
    radius_m_.push_back(obstacle.body.radius_m());
  }
  for (const world::Body& robot : model.robots) radius_m_.push_back(robot.radius_m());
}

void Resolver::body_changed(std::uint32_t id) {
  radius_m_[model_->obstacles.size() + id] = model_->robots[id].radius_m();
}

Pose2 Resolver::pose_of(std::uint32_t body, const world::Snapshot& snapshot,
                        std::span<const Mover> movers) const {
  if (!model_->is_robot(body)) return snapshot.obstacle_pose(BodyId(body));
  return movers[body - model_->obstacles.size()].X_WR;
}

Pose2 Resolver::pose_in_turn(std::uint32_t body, std::uint32_t id,
                             std::span<const Mover> movers) const {
  const auto robot = static_cast<std::uint32_t>(body - model_->obstacles.size());
  // Had there been no broad phase, that robot would not have moved yet.
  if (!ahead_.empty() && model_->is_robot(body) && robot > id && ahead_[robot] == kAhead) {
    return snapshot_->robot(RobotId(robot)).X_WR;
  }
  return pose_of(body, *snapshot_, movers);
}

void Resolver::find_near(std::uint32_t id, Vec2 p_W, double reach_m,
                         const world::Snapshot& snapshot) {
  snapshot.gather(p_W, reach_m, found_);
  near_.clear();
  const auto self = static_cast<std::uint32_t>(model_->obstacles.size()) + id;
  // Shapes come in ascending order and those of a body are next to each other, so one comparison
  // removes doubles.
  for (const std::uint32_t shape : found_) {
    const std::uint32_t body = snapshot.shape(shape).body;
    if (body != self && (near_.empty() || near_.back() != body)) near_.push_back(body);
  }
}

bool Resolver::advance_until_hit(std::uint32_t id, const Motion2& motion, std::span<Mover> movers) {
  Mover& mover = movers[id];
  impact_ = Impact{};
  bool hit = false;
  const double length_m = std::sqrt(motion.dx * motion.dx + motion.dy * motion.dy);
  const auto self = static_cast<std::uint32_t>(model_->obstacles.size()) + id;
  for (const std::uint32_t body : near_) {
    if (body == ignored_) continue;
    const Pose2 X_WB = pose_in_turn(body, id, movers);
    // A cheap test first. The broad phase relies on exactly this bound (kPassOver_m).
    if (model_->is_robot(body)) {
      const double reach = length_m + radius_m_[self] + radius_m_[body] + kPassOver_m;
      if (squared_norm(X_WB.position() - mover.X_WR.position()) > reach * reach) continue;
    }
    const Impact impact = world::time_of_impact(model_->robots[id], mover.X_WR, motion,
                                                model_->body(body), X_WB, kLimits);
    // At equal fractions the first one found stops it; their order is fixed.
    if (impact.hit && (!hit || impact.fraction < impact_.fraction)) {
      hit = true;
      impact_ = impact;
      obstacle_ = body;
    }
  }
  if (hit) mover.X_WR = advance(mover.X_WR, motion, impact_.fraction);
  return hit;
}

void Resolver::move(std::uint32_t id, const Motion2& motion_W, const world::Snapshot& snapshot,
                    double slack_m, std::span<Mover> movers, std::vector<ContactNote>& notes,
                    std::span<const std::uint8_t> ahead) {
  ahead_ = ahead;
  snapshot_ = &snapshot;
  Mover& mover = movers[id];
  const double length_m = std::sqrt(motion_W.dx * motion_W.dx + motion_W.dy * motion_W.dy);
  const auto self = static_cast<std::uint32_t>(model_->obstacles.size()) + id;
  // Once for all slides: what remains of the motion only gets shorter.
  find_near(id, mover.X_WR.position(), radius_m_[self] + length_m + slack_m + kLookAround_m,
            snapshot);
  ignored_ = BodyId::kNone;
  Motion2 rest = motion_W;
  for (int slide = 0; slide < kMaxSlides; ++slide) {
    if (!advance_until_hit(id, rest, movers)) {
      mover.X_WR = advance(mover.X_WR, rest, 1);
      return;
    }
    notes.push_back({id, BodyId(obstacle_), impact_.normal_W, false});
    rest = scaled(rest, 1 - impact_.fraction);
    const Vec2 d{rest.dx, rest.dy};
    // normal_W points into the obstacle, so a positive part of the motion presses on it.
    const double into = dot(d, impact_.normal_W);
    // What drives the body into the obstacle is taken away. If that was no translation, it was the
    // turn: the body then slides without turning.
    if (into <= 1e-12) rest.dyaw = 0;
    if (into > 0) {
      rest.dx -= into * impact_.normal_W.x;
      rest.dy -= into * impact_.normal_W.y;
    }
    if (rest.dx == 0 && rest.dy == 0 && rest.dyaw == 0) return;
  }
}

bool Resolver::push_out(std::uint32_t real, std::uint32_t id, std::span<Mover> movers) {
  for (int push = 0; push < kMaxPushes; ++push) {
    const Separation gap = world::separation(model_->robots[real], movers[real].X_WR,
                                             model_->robots[id], movers[id].X_WR);
    // The shortest way out of one overlap can lead into another body, so it is tried again from
    // there.
    const double missing = kLimits.skin_m - gap.distance_m;
    // Rounding leaves a fraction of the skin missing; less than 0.1 um needs no push.
    if (!(missing > 1e-7)) return true;
    Motion2 away{missing * gap.normal_W.x, missing * gap.normal_W.y, 0};
    for (int slide = 0; slide < kMaxSlides; ++slide) {
      if (!advance_until_hit(id, away, movers)) {
        movers[id].X_WR = advance(movers[id].X_WR, away, 1);
        break;
      }
      away = scaled(away, 1 - impact_.fraction);
      const double into = dot({away.dx, away.dy}, impact_.normal_W);
      if (into > 0) {
        away.dx -= into * impact_.normal_W.x;
        away.dy -= into * impact_.normal_W.y;
      }
    }
  }
  return world::separation(model_->robots[real], movers[real].X_WR, model_->robots[id],
                           movers[id].X_WR)
             .distance_m > -kPinnedDepth_m;
}

double Resolver::make_way(std::uint32_t id, const world::Snapshot& snapshot, double slack_m,
                          std::span<Mover> movers, std::vector<ContactNote>& notes) {
  ahead_ = {};
  snapshot_ = &snapshot;
  const auto obstacles = static_cast<std::uint32_t>(model_->obstacles.size());
  find_near(id, movers[id].X_WR.position(), radius_m_[obstacles + id] + slack_m + 1e-3, snapshot);
  // A copy, because find_near() below is asked again for each robot of the crowd.
  crowd_.clear();
  for (const std::uint32_t body : near_) {
    if (model_->is_robot(body) && movers[body - obstacles].simulated) {
      crowd_.push_back(body - obstacles);
    }
  }
  double pushed_m = 0;
  for (const std::uint32_t robot : crowd_) {
    const Separation gap = world::separation(model_->robots[id], movers[id].X_WR,
                                             model_->robots[robot], movers[robot].X_WR);
    if (gap.distance_m >= kLimits.skin_m) continue;
    // As far as all pushes together can lead, plus what those before it were pushed by.
    find_near(robot, movers[robot].X_WR.position(),
              radius_m_[obstacles + robot] + kMaxPushes * (kLimits.skin_m - gap.distance_m) +
                  slack_m + pushed_m + 1e-3,
              snapshot);
    // It overlaps the real robot, which is what the pushes end; as an obstacle it would block them.
    ignored_ = obstacles + id;
    const Vec2 p_before = movers[robot].X_WR.position();
    const bool free = push_out(id, robot, movers);
    notes.push_back({robot, BodyId(obstacles + id), -gap.normal_W, !free});
    const Vec2 push = movers[robot].X_WR.position() - p_before;
    pushed_m = std::max(pushed_m, std::sqrt(squared_norm(push)));
  }
  return pushed_m;
}

void Resolver::probe(std::uint32_t id, const world::Snapshot& snapshot, double slack_m,
                     double within_m, std::span<const Mover> movers,
                     std::vector<ContactNote>& notes, LayerMask layers) {
  const auto obstacles = static_cast<std::uint32_t>(model_->obstacles.size());
  find_near(id, movers[id].X_WR.position(), radius_m_[obstacles + id] + slack_m + within_m,
            snapshot);
  // The nearest one only: a contact sensor reports one direction only.
  Separation least;
  least.distance_m = within_m;
  std::uint32_t nearest = BodyId::kNone;
  for (const std::uint32_t body : near_) {
    if (!contains(layers, model_->body(body).layer)) continue;
    const Separation gap = world::separation(model_->robots[id], movers[id].X_WR,
                                             model_->body(body), pose_of(body, snapshot, movers));
    if (gap.distance_m < least.distance_m) {
      least = gap;
      nearest = body;
    }
  }
  if (nearest != BodyId::kNone) notes.push_back({id, BodyId(nearest), least.normal_W, false});
}

}  // namespace rave::sim
