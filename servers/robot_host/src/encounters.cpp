// SPDX-License-Identifier: Apache-2.0
#include "encounters.hpp"

#include <algorithm>
#include <cmath>

#include "rave/world/touching.hpp"

namespace rave::robot_host {
namespace {

/// Above this many robots every tenth step must do.
constexpr std::size_t kManyRobots = 100;

std::string pair_name(std::string_view a, std::string_view b) { return fmt::format("{}-{}", a, b); }

}  // namespace

Encounters::Encounters(const BodyKinds& kinds, const sim::EngineSpec& spec)
    : kinds_(&kinds), every_(spec.robots.size() > kManyRobots ? 10 : 1) {
  for (std::uint32_t body = 0; body < spec.world.body_count(); ++body) {
    radius_m_.push_back(spec.world.body(body).radius_m());
  }
}

void Encounters::after_step(sim::Engine& engine) {
  if ((engine.steps_done() - 1) % every_ != 0) return;
  const auto count = static_cast<std::uint32_t>(engine.spec().robots.size());
  const world::WorldModel& model = engine.spec().world;
  while (radius_m_.size() < model.body_count()) {
    radius_m_.push_back(model.body(static_cast<std::uint32_t>(radius_m_.size())).radius_m());
  }
  for (std::uint32_t r = 0; r < count; ++r) {
    if (!engine.is_local(RobotId(r)) || !engine.snapshot().robot(RobotId(r)).present) continue;
    look_around(engine, RobotId(r));
  }
}

void Encounters::look_around(const sim::Engine& engine, RobotId robot) {
  const world::Snapshot& world = engine.snapshot();
  const world::WorldModel& model = world.model();
  const std::uint32_t self = kinds_->body_of(robot);
  const auto obstacles = static_cast<std::uint32_t>(model.obstacles.size());
  const Pose2 X_WR = world.pose(robot);
  radius_m_[self] = engine.body_radius_m(robot);  // it may have been scaled
  world.gather(X_WR.position(), radius_m_[self] + kReach_m, found_);
  std::uint32_t last = BodyId::kNone;
  for (const std::uint32_t shape : found_) {
    const std::uint32_t body = world.shape(shape).body;
    if (body == last || body == self) continue;
    last = body;
    const bool other_robot = kinds_->is_robot(body);
    if (other_robot && body < self) continue;  // each pair once
    if (other_robot) radius_m_[body] = engine.body_radius_m(RobotId(body - obstacles));
    const Pose2 X_WB =
        other_robot ? world.pose(RobotId(body - obstacles)) : world.obstacle_pose(BodyId(body));
    const double centres_m = std::sqrt(squared_norm(X_WB.position() - X_WR.position()));
    // Real robots come first in a name, so that each kind of pair has one.
    const bool swap = other_robot && kinds_->word(self) > kinds_->word(body);
    const std::string name = swap ? pair_name(kinds_->word(body), kinds_->word(self))
                                  : pair_name(kinds_->word(self), kinds_->word(body));
    const auto known = closest_.find(name);
    if (known != closest_.end() &&
        centres_m - radius_m_[self] - radius_m_[body] >= known->second.gap_m) {
      continue;
    }
    const double gap_m =
        world::separation(model.body(self), X_WR, model.body(body), X_WB).distance_m;
    if (!std::isfinite(gap_m)) continue;
    if (known != closest_.end() && gap_m >= known->second.gap_m) continue;
    closest_[name] = {gap_m, centres_m, world.time().seconds(), self, body};
  }
}

std::string Encounters::headline() const {
  const std::pair<const std::string, Encounter>* best = nullptr;
  for (const auto& entry : closest_) {
    if (!kinds_->is_robot(entry.second.b)) continue;
    if (best == nullptr || entry.second.gap_m < best->second.gap_m) best = &entry;
  }
  if (best == nullptr) return {};
  return fmt::format("closest {} {:.2f} m", best->first, std::max(best->second.gap_m, 0.0));
}

}  // namespace rave::robot_host
