// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/report/progress.hpp"

namespace rave::runtime {

struct VerifyOptions {
  std::filesystem::path program_runner;  ///< The executable for isolated programs.
  unsigned threads = 0;                  ///< 0: as many as in the recorded run.
  LogSink* log = nullptr;                ///< Not owned; outlives the call.
  /// Called in the calling thread about ten times a second of wall time; may be empty.
  std::function<void(const report::Progress&)> on_progress;
  RunControl* control = nullptr;  ///< Ends it from another thread; may be null. Not owned.
};

/// The first difference between two runs: the first item of the first step that is not
/// bit-identical.
struct RunDifference {
  std::uint64_t step = 0;
  double time_s = 0;
  std::string robot;    ///< Empty: it concerns the whole run.
  std::string channel;  ///< `pose`, `sensor laser`, `command of drive`, `event`, ...
  std::string text;     ///< The recorded and the present value.
};

struct VerifyOutcome {
  /// Why the recording cannot be verified: it is of a live run. Otherwise empty.
  std::string live_reason;
  std::vector<std::string> missing;  ///< Missing input files; if there are any, nothing was run.
  std::vector<std::string> notes;    ///< Changed input files and versions.
  std::uint64_t steps = 0;           ///< Number of repeated steps.
  double time_s = 0;                 ///< Simulated time of them.
  std::uint64_t recorded_steps = 0;
  std::uint64_t messages = 0;  ///< Number of compared messages.
  std::optional<std::uint64_t> recorded_hash;
  std::optional<std::uint64_t> hash;  ///< Set if all recorded steps were repeated.
  std::optional<RunDifference> difference;
  bool ended_early = false;  ///< Stopped through `control`.
  /// Why not the whole run was compared, one sentence each: the recording breaks off, or lacks a
  /// stream. Empty: all of it was.
  std::vector<std::string> partial;

  [[nodiscard]] bool same() const noexcept {
    return live_reason.empty() && missing.empty() && !difference && !ended_early && partial.empty();
  }
};

/// Repeats the run of a recording with the scenario in it. The recording of one lock-step host of
/// several is repeated with its robots in one engine and the others in another. Compares every
/// pose, percept, command, actuator command, radio packet and event with the recording, and the run
/// hash after each step. Stops after the first step that differs. Writes only a temporary file.
/// Errors: the recording cannot be read, or the scenario cannot be run here.
[[nodiscard]] Result<VerifyOutcome> verify(const std::filesystem::path& record,
                                           plugin::Catalogue& catalogue,
                                           const VerifyOptions& options);

}  // namespace rave::runtime
