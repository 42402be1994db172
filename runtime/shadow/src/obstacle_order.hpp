// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "rave/sim/event.hpp"

namespace rave::runtime {

/// What became of obstacles in one step, in an order in which it can be done again. The events of a
/// step are sorted by kind, so one that was replaced by another of its name seems to come before
/// the first has gone. What stood before and went is first, then one obstacle after the other: it
/// comes, moves, goes. What moved and went in the same step went.
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
