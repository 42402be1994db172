// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "rave/base/result.hpp"
#include "rave/record/run_record.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

class BodyKinds;

/// A run before its first step, for observers. Views; valid during the call only.
struct RunView {
  const sim::Engine& engine;
  const BodyKinds& kinds;       ///< Valid as long as the run.
  const record::RunInfo& info;  ///< Robots, and sensors of the robots that run here.
  /// Hybrid sensors: `robot/sensor` to a description of the parts.
  const record::StringMap& hybrids;
  bool live = false;  ///< In real time, so it cannot be paused.
};

/// A completed step, for observers. Views; valid during the call only.
struct StepView {
  // Implicit, because most observers need the engine only.
  StepView(sim::Engine& of, std::span<const sim::Event> others = {},  // NOLINT(*-explicit-*)
           bool is_late = false)
      : engine(of), beside(others), late(is_late) {}

  sim::Engine& engine;                 ///< Its snapshot is the world that the step sensed.
  std::span<const sim::Event> beside;  ///< Obstacle events, if the engine is one of several hosts.
  bool late;  ///< Steps are late: observers should reduce their work if they can.
};

/// Observes a run, in the same way in one process, in lock-step and in real time. It may query the
/// engine's history, but must not change anything that the run depends on. All calls come from the
/// thread of the run, which waits for them; do long work elsewhere.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// Called when the run is ready, before its first step. An error prevents the start.
  virtual Status run_begins(const RunView& /*run*/) { return {}; }
  /// Called after each step.
  virtual void after_step(const StepView& step) = 0;
  /// Called when all observers have seen the step; `all`, in the order of the list, with what they
  /// found.
  virtual void after_all(const StepView& /*step*/, std::span<RunObserver* const> /*all*/) {}
  /// Called repeatedly while the run is paused, with the state of the last step.
  virtual void held(const sim::Engine& /*engine*/) {}
  /// Events that the observer found in the last step, for log and recording.
  [[nodiscard]] virtual std::span<const sim::Event> events() const noexcept { return {}; }
  /// Adds its measurements of the last step to the recording.
  virtual void record(record::RunRecorder& /*recorder*/) const {}
};

/// The event in words, after the name of its kind: `with NAME`, or a sentence.
[[nodiscard]] std::string words_of(const BodyKinds& kinds, const sim::Event& event);

}  // namespace rave::runtime
