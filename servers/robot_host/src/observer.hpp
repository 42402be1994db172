// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/sim/engine.hpp"

namespace rave::robot_host {

/// Looks at a run after each step and gathers something for its results. It may ask the engine
/// about the past, but changes nothing that the run depends on.
class Observer {
 public:
  virtual ~Observer() = default;
  /// The engine has just done a step; its snapshot shows the world as that step sensed it.
  virtual void after_step(sim::Engine& engine) = 0;
};

}  // namespace rave::robot_host
