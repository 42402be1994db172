// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "commands/run.hpp"
#include "console.hpp"
#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/control/server.hpp"
#include "rave/host/run.hpp"
#include "rave/launch/companions.hpp"
#include "rave/launch/run_folder.hpp"

namespace rave::cli {

/// What every command that starts a process of a run begins with: the folder, the console with its
/// file, the control that signals end, and the socket for other terminals. One thread.
class RunStart {
 public:
  /// Creates the folder; `name` is for a folder that the user has not named. Errors: those of
  /// RunFolder::create() and Console::open_file().
  [[nodiscard]] static Result<std::unique_ptr<RunStart>> open(const RunCommand& options,
                                                              std::string_view name);

  /// Lets other terminals control this process under `run_name` for as long as this object lives.
  /// If that is not possible the process continues, and the log says that `what` cannot be
  /// controlled: people who rely on `rave stop` must know.
  void serve(const std::string& run_name, std::string_view source, std::string_view what);

  /// What the command line says of a run in this process. Borrows the console and the control.
  [[nodiscard]] runtime::RunOptions run_options(const RunCommand& options, std::string run_name);

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return folder_.path(); }
  [[nodiscard]] Console& console() noexcept { return console_; }
  [[nodiscard]] runtime::RunControl& control() noexcept { return control_; }
  /// For a run that did not start: as RunFolder::discard().
  void discard() const { folder_.discard(); }

 private:
  RunStart(launch::RunFolder folder, bool quiet);

  launch::RunFolder folder_;
  Console console_;
  runtime::RunControl& control_;
  std::unique_ptr<control::Server> server_;
};

/// Starts the companions of a run and tells its robots their folder.
[[nodiscard]] Result<std::unique_ptr<launch::Companions>> start_companions(
    const RunCommand& options, config::ExpandedScenario& scenario, RunStart& start);

/// Ends them after the run, which is not whole if it had to end with one of them.
void end_companions(launch::Companions& companions, Result<runtime::RunOutcome>& outcome);

}  // namespace rave::cli
