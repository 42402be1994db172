// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/results/capture_watch.hpp"
#include "rave/results/encounters.hpp"
#include "rave/results/facts.hpp"
#include "rave/results/goal_checks.hpp"
#include "rave/results/hit_counter.hpp"
#include "rave/results/instant.hpp"
#include "rave/results/sighting_check.hpp"
#include "rave/results/track_recorder.hpp"

namespace rave::runtime {

/// All who look at a run for its results.
struct Observers {
  BodyKinds kinds;
  TrackRecorder tracks;
  Encounters encounters;
  HitCounter hits;
  GoalChecks goals;
  std::optional<SightingCheck> sightings;
  std::optional<InstantKeeper> instant;
  std::optional<CaptureWatch> capture;  ///< Only where all robots are.

  /// `spec`: of the engine that is looked at. `with_tracks`: where robots were is kept, for the
  /// picture. Refers to the engine's and to itself.
  Observers(const config::ExpandedScenario& scenario, const std::vector<std::string>& robot_kinds,
            const sim::EngineSpec& spec, bool with_tracks);
  Observers(const Observers&) = delete;
  Observers& operator=(const Observers&) = delete;

  void after_step(const StepView& step);
  /// What they found in the last step.
  [[nodiscard]] std::span<const sim::Event> events() const noexcept {
    return capture ? capture->events() : std::span<const sim::Event>();
  }
};

/// What observers need of the past: set before the scenario is built.
void keep_history_for_observers(config::ScenarioFile& scenario);

/// What is known of the robots that run here when all steps are done, but for events and problems.
[[nodiscard]] RunFacts gather(const Observers& observers, const sim::Engine& engine);

}  // namespace rave::runtime
