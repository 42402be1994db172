// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "rave/sim/event.hpp"

namespace rave::runtime {

/// The changes of obstacles in one step, in an order in which they can be repeated. The events of a
/// step are sorted by kind, so an obstacle that replaces another of its name seems to appear before
/// the first is removed. Here the removals of earlier obstacles come first; then each obstacle in
/// turn: added, moved, removed. An obstacle that was moved and removed in one step is only removed.
[[nodiscard]] inline std::vector<sim::Event> obstacle_events_in_order(
    std::span<const sim::Event> events) {
  const auto is_there = [events](sim::EventKind kind, BodyId obstacle) {
    return std::ranges::any_of(events, [&](const sim::Event& event) {
      return event.kind == kind && event.other == obstacle;
    });
  };
  std::vector<sim::Event> ordered;
  for (const sim::Event& event : events) {
    if (!sim::is_of_obstacle(event.kind)) continue;
    const bool moved = event.kind == sim::EventKind::kObstacleMoved;
    if (moved && is_there(sim::EventKind::kObstacleRemoved, event.other)) continue;
    ordered.push_back(event);
  }
  const auto place = [&](const sim::Event& event) {
    const bool went = event.kind == sim::EventKind::kObstacleRemoved;
    const bool stood = !is_there(sim::EventKind::kObstacleAdded, event.other);
    return std::tuple(went && stood ? 0 : 1, event.other.value(),
                      static_cast<std::uint32_t>(event.kind));
  };
  std::ranges::stable_sort(
      ordered, [&](const sim::Event& a, const sim::Event& b) { return place(a) < place(b); });
  return ordered;
}

}  // namespace rave::runtime
