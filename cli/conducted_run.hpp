// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/run.hpp"
#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/gui_server/gui_server.hpp"
#include "rave/process/child.hpp"

namespace rave::cli {

/// A run that a page started: a process `rave run` that ends with this one, and the page that looks
/// on at it over the bus. One owner thread.
class ConductedRun {
 public:
  /// Starts the run and shows it on the page, which outlives it. `asked`: scenario, seed, plug-ins,
  /// bus and page options. Errors: those of read_scenario(), RunFolder::create(), the bus and the
  /// world of the run; kIo (no process).
  [[nodiscard]] static Result<std::unique_ptr<ConductedRun>> start(
      const RunCommand& asked, const config::ExpandedScenario& scenario,
      gui_server::GuiServer& page, LogSink& log);
  ConductedRun(const ConductedRun&) = delete;
  ConductedRun& operator=(const ConductedRun&) = delete;
  /// Ends the run if it is still in progress; kills it if it takes too long.
  ~ConductedRun();

  [[nodiscard]] const std::filesystem::path& folder() const noexcept { return folder_; }
  /// Waits for its end, at most for that long; empty while it runs.
  [[nodiscard]] std::optional<process::ChildEnd> wait(std::chrono::milliseconds longest);
  /// The id of its process; 0: it has ended.
  [[nodiscard]] int process() const noexcept { return child_.id(); }
  /// Asks it to end and to write its results; a second time it is killed.
  void end();
  /// The newest lines of its log, at most `lines`.
  [[nodiscard]] std::vector<std::string> log_lines(std::size_t lines) const;

 private:
  ConductedRun() = default;
  Status start_process(const RunCommand& options);
  Status show_on(const RunCommand& options, const config::ExpandedScenario& scenario,
                 gui_server::GuiServer& page, LogSink& log);

  std::filesystem::path folder_;
  process::Child child_;
  bool asked_to_end_ = false;
};

}  // namespace rave::cli
