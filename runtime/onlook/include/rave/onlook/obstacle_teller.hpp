// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rave/bus/writer.hpp"
#include "rave/sim/engine.hpp"

namespace rave::onlook {

/// Tells which obstacles are not as at the start (topic rave/last_obstacle), where no manager tells
/// the host: in lock-step, and in real time without one. All hosts of a run say the same with the
/// same revisions. Must be gone before its bus; thread: that of the bus.
class ObstacleTeller {
 public:
  explicit ObstacleTeller(bus::Writer<bus::LastObstacle> writer) : writer_(std::move(writer)) {}

  /// Before the first step: the obstacles of the start.
  void begin(const sim::EngineSpec& spec);
  /// A step is done, in which the engine had events of obstacles, or others `beside` it.
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
  std::uint64_t next_step_ = 0;  ///< The one that follows the last that was seen.
};

}  // namespace rave::onlook
