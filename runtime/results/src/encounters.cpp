// SPDX-License-Identifier: Apache-2.0
#include "rave/results/encounters.hpp"

#include <algorithm>
#include <cmath>

#include "rave/world/touching.hpp"

namespace rave::runtime {
namespace {

/// Above this number of robots, only every tenth step is examined.
constexpr std::size_t kManyRobots = 100;

}  // namespace

Encounters::Encounters(const BodyKinds& kinds, const sim::EngineSpec& spec)
    : kinds_(&kinds), every_(spec.robots.size() > kManyRobots ? 10 : 1) {
  for (std::uint32_t body = 0; body < spec.world.body_count(); ++body) {
    radius_m_.push_back(spec.world.body(body).radius_m());
  }
}

void Encounters::after_step(const StepView& step) {
  const sim::Engine& engine = step.engine;
  if ((engine.steps_done() - 1) % every_ != 0) return;
  const auto count = static_cast<std::uint32_t>(engine.spec().robots.size());
  const world::WorldModel& model = engine.spec().world;
  while (radius_m_.size() < model.body_count()) {
    radius_m_.push_back(model.body(static_cast<std::uint32_t>(radius_m_.size())).radius_m());
  }
  foresee_kinds();
  reach_now_m_ = reach_m();
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
  radius_m_[self] = engine.body_radius_m(robot);  // The radius may have been changed by scaling.
  // Only bodies that could be closer than what is known are looked at. The closest distances shrink
  // during the run, so the search becomes cheaper.
  world.gather(X_WR.position(), radius_m_[self] + reach_now_m_, found_);
  std::uint32_t last = BodyId::kNone;
  for (const std::uint32_t shape : found_) {
    const std::uint32_t body = world.shape(shape).body;
    // A body with several shapes comes several times in a row.
    if (body == last || body == self) continue;
    last = body;
    const bool other_robot = kinds_->is_robot(body);
    if (other_robot && body < self) continue;  // Each pair once.
    if (other_robot) radius_m_[body] = engine.body_radius_m(RobotId(body - obstacles));
    const Pose2 X_WB =
        other_robot ? world.pose(RobotId(body - obstacles)) : world.obstacle_pose(BodyId(body));
    const double centres_m = std::sqrt(squared_norm(X_WB.position() - X_WR.position()));
    std::optional<Encounter>& closest = kind_of(self, body).closest;
    // The distance by the radii is a lower bound, and cheaper than the exact one.
    if (closest && centres_m - radius_m_[self] - radius_m_[body] >= closest->gap_m) continue;
    const double gap_m =
        world::separation(model.body(self), X_WR, model.body(body), X_WB).distance_m;
    if (!std::isfinite(gap_m) || (closest && gap_m >= closest->gap_m)) continue;
    closest = {gap_m, centres_m, world.time().seconds(), self, body};
  }
}

/// Called for each robot, neighbour and step, so words are compared by address instead of by text.
Encounters::Kind& Encounters::kind_of(std::uint32_t robot, std::uint32_t other) {
  std::string_view a = kinds_->word(robot);
  std::string_view b = kinds_->word(other);
  // Real robots come first in a name, so that each kind of pair has exactly one.
  if (kinds_->is_robot(other) && a > b) std::swap(a, b);
  for (Kind& kind : kinds_of_pairs_) {
    if (kind.a.data() == a.data() && kind.b.data() == b.data()) return kind;
  }
  return kinds_of_pairs_.emplace_back(Kind{a, b});
}

/// Creates an entry for each kind of pair that is possible from now on.
void Encounters::foresee_kinds() {
  if (foreseen_ == kinds_->revision()) return;
  foreseen_ = kinds_->revision();
  // One body for each word.
  std::vector<std::uint32_t> bodies;
  for (std::uint32_t body = 0; body < kinds_->count(); ++body) {
    const auto same = [&](std::uint32_t other) {
      return kinds_->word(other).data() == kinds_->word(body).data();
    };
    if (std::ranges::none_of(bodies, same)) bodies.push_back(body);
  }
  for (const std::uint32_t robot : bodies) {
    if (!kinds_->is_robot(robot)) continue;
    for (const std::uint32_t other : bodies) static_cast<void>(kind_of(robot, other));
  }
}

/// A body closer than this may be closer than the closest of its kind, whichever kind that is.
double Encounters::reach_m() const {
  double reach_m = 0;
  for (const Kind& kind : kinds_of_pairs_) {
    reach_m = std::max(reach_m, kind.closest ? kind.closest->gap_m : kReach_m);
  }
  return std::min(reach_m, kReach_m);
}

std::map<std::string, Encounter> Encounters::closest() const {
  std::map<std::string, Encounter> all;
  for (const Kind& kind : kinds_of_pairs_) {
    if (!kind.closest) continue;
    const auto [entry, added] = all.emplace(fmt::format("{}-{}", kind.a, kind.b), *kind.closest);
    if (!added && kind.closest->gap_m < entry->second.gap_m) entry->second = *kind.closest;
  }
  return all;
}

std::string Encounters::headline() const {
  const Kind* best = nullptr;
  for (const Kind& kind : kinds_of_pairs_) {
    if (!kind.closest || !kinds_->is_robot(kind.closest->b)) continue;
    if (best == nullptr || kind.closest->gap_m < best->closest->gap_m) best = &kind;
  }
  if (best == nullptr) return {};
  return fmt::format("closest {}-{} {:.2f} m", best->a, best->b,
                     std::max(best->closest->gap_m, 0.0));
}

}  // namespace rave::runtime
