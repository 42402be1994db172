// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "rave/base/result.hpp"
#include "rave/record/run_record.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

class BodyKinds;

/// A run before its first step, as observers get it. Views; they hold during the call alone.
struct RunView {
  const sim::Engine& engine;
  const BodyKinds& kinds;            ///< Stays as long as the run.
  const record::RunInfo& info;       ///< Robots, and sensors of those that run here.
  const record::StringMap& hybrids;  ///< `robot/sensor` of hybrid sensors, and of what they are.
  bool live = false;                 ///< In real time: it cannot be held.
};

/// A step that is done, as observers get it. Views; they hold during the call alone.
struct StepView {
  // Implicit, since most observers need nothing else.
  StepView(sim::Engine& of, std::span<const sim::Event> others = {},  // NOLINT(*-explicit-*)
           bool is_late = false)
      : engine(of), beside(others), late(is_late) {}

  sim::Engine& engine;                 ///< Its snapshot shows the world as that step sensed it.
  std::span<const sim::Event> beside;  ///< Of obstacles, where the engine is one of several hosts.
  bool late;                           ///< Steps come late: who can do with less does less.
};

/// Looks at a run, alike in one process, in lock-step and in real time. It may ask the engine about
/// the past, but changes nothing that the run depends on. All calls come from the thread of the
/// run, which waits for them: what takes long belongs elsewhere.
class RunObserver {
 public:
  virtual ~RunObserver() = default;
  /// The run is there, its first step is not done. Errors keep it from starting.
  virtual Status run_begins(const RunView& /*run*/) { return {}; }
  /// A step has just been done.
  virtual void after_step(const StepView& step) = 0;
  /// The run is held: the last step stands. Called now and then until it goes on.
  virtual void held(const sim::Engine& /*engine*/) {}
  /// What it found in the last step, for log and recording.
  [[nodiscard]] virtual std::span<const sim::Event> events() const noexcept { return {}; }
  /// Puts what it measured in the last step into the recording.
  virtual void record(record::RunRecorder& /*recorder*/) const {}
};

/// What happened, for people, behind the kind of the event: `with NAME`, or a sentence.
[[nodiscard]] std::string words_of(const BodyKinds& kinds, const sim::Event& event);

}  // namespace rave::runtime
