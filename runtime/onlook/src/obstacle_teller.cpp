// SPDX-License-Identifier: Apache-2.0
#include "rave/onlook/obstacle_teller.hpp"

#include <algorithm>

#include "rave/protocol/obstacle_messages.hpp"
#include "rave/sim/obstacle_change.hpp"

namespace rave::onlook {
namespace {

/// The numbers of changes within one step are below this.
constexpr std::uint64_t kOfStep = rave_wire_kMaxObstacleChanges;

bool same_place(const Pose2& a, const Pose2& b) noexcept {
  return a.x == b.x && a.y == b.y && a.yaw == b.yaw;
}

}  // namespace

void ObstacleTeller::begin(const sim::EngineSpec& spec) {
  start_.clear();
  const world::WorldModel& world = spec.world;
  for (std::size_t o = 0; o < world.obstacle_count(); ++o) {
    const std::uint32_t id = world.obstacle_id(o);
    start_.push_back({id, world.obstacle(id)->X_WB});
  }
  std::ranges::sort(start_, {}, &Start::id);
}

void ObstacleTeller::after_step(const sim::Engine& engine, std::span<const sim::Event> beside) {
  const std::uint64_t step = engine.steps_done() == 0 ? 0 : engine.steps_done() - 1;
  // An absent host has seen no events of the changes in between.
  if (step > next_step_) compare(engine);
  next_step_ = step + 1;
  std::uint64_t revision = (step + 1) * kOfStep;
  for (const std::span<const sim::Event> events : {engine.events(), beside}) {
    for (const sim::Event& event : events) {
      if (is_of_obstacle(event.kind) && event.other.valid()) {
        tell(engine, event.other.value(), revision++);
      }
    }
  }
}

void ObstacleTeller::compare(const sim::Engine& engine) {
  const world::WorldModel& world = engine.spec().world;
  for (std::size_t o = 0; o < world.obstacle_count(); ++o) {
    const std::uint32_t id = world.obstacle_id(o);
    const world::Obstacle& now = *world.obstacle(id);
    const auto start = std::ranges::lower_bound(start_, id, {}, &Start::id);
    const bool stood = start != start_.end() && start->id == id;
    if (stood && !now.removed && same_place(start->X_WB, now.X_WB)) continue;
    tell(engine, id, next_step_ * kOfStep + 1);
  }
}

void ObstacleTeller::tell(const sim::Engine& engine, std::uint32_t id, std::uint64_t revision) {
  const world::Obstacle* const obstacle = engine.spec().world.obstacle(id);
  if (obstacle == nullptr) return;
  sim::ObstacleChange stands;
  stands.id = BodyId(id);
  stands.name = obstacle->body.name;
  stands.X_WB = obstacle->X_WB;
  stands.body = obstacle->body;
  lock_step::ObstacleParts parts;
  // A body of the scenario that cannot be sent on the bus stays unchanged for monitors.
  if (!parts.fill(std::span(&stands, 1))) return;
  bus::LastObstacle message{};
  message.id = id;
  message.revision = revision;
  message.removed = obstacle->removed;
  message.stands = parts.changes().front();
  static_cast<void>(writer_.write(message));
}

}  // namespace rave::onlook
