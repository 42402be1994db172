// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/results/capture_watch.hpp"
#include "rave/results/encounters.hpp"
#include "rave/results/facts.hpp"
#include "rave/results/goal_checks.hpp"
#include "rave/results/hit_counter.hpp"
#include "rave/results/instant.hpp"
#include "rave/results/sighting_check.hpp"
#include "rave/results/track_recorder.hpp"

namespace rave::runtime {

/// All observers that collect the facts of a run.
struct Observers final : RunObserver {
  BodyKinds kinds;
  TrackRecorder tracks;
  Encounters encounters;
  HitCounter hits;
  GoalChecks goals;
  std::optional<SightingCheck> sightings;
  std::optional<InstantKeeper> instant;
  std::optional<CaptureWatch> capture;  ///< Only if this process has all robots.

  /// `spec`: that of the engine. `with_tracks`: record the tracks for the picture. Keeps references
  /// to the engine's data and to its own members.
  Observers(const config::ExpandedScenario& scenario, const std::vector<std::string>& robot_kinds,
            const sim::EngineSpec& spec, bool with_tracks);
  Observers(const Observers&) = delete;
  Observers& operator=(const Observers&) = delete;

  void after_step(const StepView& step) override;
  [[nodiscard]] std::span<const sim::Event> events() const noexcept override {
    return capture ? capture->events() : std::span<const sim::Event>();
  }
};

/// Extends the history of a scenario to what observers need; call it before building the scenario.
void keep_history_for_observers(config::ScenarioFile& scenario);

/// The facts of the robots that run here after the last step, without events and problems.
[[nodiscard]] RunFacts gather(const Observers& observers, const sim::Engine& engine);

}  // namespace rave::runtime
