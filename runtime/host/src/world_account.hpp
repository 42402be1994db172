// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include "rave/config/expanded_scenario.hpp"
#include "rave/results/capture_watch.hpp"
#include "rave/results/facts.hpp"
#include "rave/sim/authority_state.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::runtime {

/// What a host in lock-step sees of the world of all robots: contacts, pins, captures, changes of
/// bodies and obstacles. The environment manager knows the same, but for its own time only; who
/// takes its place has the rest from here. Belongs to one thread.
class WorldAccount {
 public:
  /// `scenario` and `spec` are not owned.
  WorldAccount(const config::ExpandedScenario& scenario, const sim::EngineSpec& spec);

  /// A world has come, with what its authority said beside. Of a world that does not follow on the
  /// one before it begins anew, and also when it would be too much.
  void take(const sim::WorldStep& world, const sim::AuthorityState& authority);
  /// The step of that world is done here; by the authority with the next world.
  void after_step(sim::Engine& engine);

  /// Of the steps that the authority has finished.
  [[nodiscard]] WorldFacts facts() const;

 private:
  void begin_at(std::uint64_t step);
  void note(std::span<const sim::Event> events);
  void take_sizes(const sim::WorldStep& world);

  const config::ExpandedScenario& scenario_;
  const sim::EngineSpec& spec_;
  std::optional<CaptureWatch> capture_;
  std::map<std::uint32_t, double> scales_;  ///< By robot, of those that have changed.
  WorldFacts told_;
  std::optional<std::uint64_t> looked_at_;  ///< The last step in which captures were looked for.
  bool begun_ = false;
};

}  // namespace rave::runtime
