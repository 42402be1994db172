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
  unsigned threads = 0;                  ///< 0: as many as the recorded run had.
  LogSink* log = nullptr;                ///< Not owned; outlives the call.
  /// Called in the calling thread about ten times a second of wall time; may be empty.
  std::function<void(const report::Progress&)> on_progress;
  RunControl* control = nullptr;  ///< Ends it from elsewhere; may be null. Not owned.
};

/// Where two runs part: the first item of the first step that is not the same to the bit.
struct RunDifference {
  std::uint64_t step = 0;
  double time_s = 0;
  std::string robot;    ///< Empty: it concerns the run.
  std::string channel;  ///< `pose`, `sensor laser`, `command of drive`, `event`, ...
  std::string text;     ///< What was recorded and what is now.
};

struct VerifyOutcome {
  /// Why the record cannot be verified: it is of a live run. Empty if it can.
  std::string live_reason;
  std::vector<std::string> missing;  ///< Input files that are not there; nothing was run then.
  std::vector<std::string> notes;  ///< Input files and versions that differ, a record that is cut.
  std::uint64_t steps = 0;         ///< Done again.
  std::uint64_t recorded_steps = 0;
  std::uint64_t messages = 0;  ///< Compared.
  std::optional<std::uint64_t> recorded_hash;
  std::optional<std::uint64_t> hash;  ///< Set if all recorded steps were done.
  std::optional<RunDifference> difference;
  bool ended_early = false;  ///< Somebody stopped it.

  [[nodiscard]] bool same() const noexcept {
    return live_reason.empty() && missing.empty() && !difference && !ended_early;
  }
};

/// Runs the scenario inside a record again, as it says (of a host of several in lock-step: its
/// robots in one engine, the others in another), and compares every pose, percept, command,
/// actuator command, radio packet and event with those of the record, and the run hash after each
/// step. Stops behind the first step that differs. Writes only a temporary file. Errors: the record
/// cannot be read, or the scenario cannot be run here.
[[nodiscard]] Result<VerifyOutcome> verify(const std::filesystem::path& record,
                                           plugin::Catalogue& catalogue,
                                           const VerifyOptions& options);

}  // namespace rave::runtime
