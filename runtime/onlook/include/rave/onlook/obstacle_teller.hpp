// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rave/bus/writer.hpp"
#include "rave/sim/engine.hpp"

namespace rave::onlook {

/// Publishes the obstacles that differ from their initial state (topic rave/last_obstacle). Used
/// where no manager publishes them for the host: in lock-step, and in real time without a manager.
/// All hosts of a run publish the same data with the same revisions. Destroy it before its bus;
/// thread: that of the bus.
class ObstacleTeller {
 public:
  explicit ObstacleTeller(bus::Writer<bus::LastObstacle> writer) : writer_(std::move(writer)) {}

  /// Call it before the first step, with the initial obstacles.
  void begin(const sim::EngineSpec& spec);
  /// Call it after a step with obstacle events of the engine, or with others in `beside`.
  void after_step(const sim::Engine& engine, std::span<const sim::Event> beside);

 private:
  struct Start {
    std::uint32_t id = 0;
    Pose2 X_WB;
  };
  void compare(const sim::Engine& engine);
  void tell(const sim::Engine& engine, std::uint32_t id, std::uint64_t revision);

  bus::Writer<bus::LastObstacle> writer_;
  std::vector<Start> start_;     ///< Ascending.
  std::uint64_t next_step_ = 0;  ///< The step after the last one seen.
};

}  // namespace rave::onlook
