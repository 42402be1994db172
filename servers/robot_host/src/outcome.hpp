// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "capture_watch.hpp"
#include "encounters.hpp"
#include "goal_checks.hpp"
#include "hit_counter.hpp"
#include "instant.hpp"
#include "rave/robot_host/build.hpp"
#include "rave/robot_host/run.hpp"
#include "shadows.hpp"
#include "sighting_check.hpp"
#include "track_recorder.hpp"

namespace rave::robot_host {

/// Everything that was gathered while a run went, when it has ended.
struct Findings {
  const config::ExpandedScenario& scenario;
  const BuiltScenario& built;
  const BodyKinds& kinds;
  const sim::Engine& engine;
  const TrackRecorder& tracks;
  const Encounters& encounters;
  const HitCounter& hits;
  std::vector<CheckResult> goals;
  const SightingCheck* sightings = nullptr;
  const InstantKeeper* instant = nullptr;
  const CaptureWatch* capture = nullptr;
  const Shadows* shadows = nullptr;
  const std::vector<sim::Event>& events;
  double wall_s = 0;
  bool ended_early = false;
  std::string record_problem;  ///< Why run.mcap is not whole; empty if it is.
};

/// What the run amounts to: whole or not, checks, hash.
[[nodiscard]] RunOutcome judge(const Findings& findings);

/// The content of result.json.
[[nodiscard]] std::string result_json(const Findings& findings, const RunOutcome& outcome);

/// The table of the summary for a terminal.
[[nodiscard]] std::string summary_text(const Findings& findings, const RunOutcome& outcome);

/// The picture of the run.
[[nodiscard]] report::Picture make_picture(const Findings& findings, const RunOutcome& outcome);

}  // namespace rave::robot_host
