// SPDX-License-Identifier: Apache-2.0
#include "commands/play.hpp"

#include <fmt/format.h>

#include "error_text.hpp"
#include "places.hpp"
#include "rave/launch/run_folder.hpp"

namespace rave::cli {
namespace {

namespace fs = std::filesystem;

/// In the folder of a run, the scenario that was made for it.
constexpr const char* kScenarioFolder = "played";

Result<replay::PlayedScenario> make(const PlayCommand& options) {
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue(options.run.plugins));
  replay::PlayArguments arguments = options.how;
  RAVE_TRY_ASSIGN(arguments.record, record_file(options.file));
  if (!options.write.empty()) {
    arguments.folder = options.write;
  } else {
    // The folder of a run is made later, but all that get a name of their own are side by side.
    arguments.folder =
        fs::path(options.run.output.empty() ? "runs/new" : options.run.output) / kScenarioFolder;
  }
  return replay::played_scenario(arguments, *catalogue);
}

/// The recording is read throughout the run, so `--replace` must not remove it.
Status keeps_its_record(const PlayCommand& options) {
  if (!options.run.replace || options.run.output.empty()) return {};
  RAVE_TRY_ASSIGN(const fs::path record, record_file(options.file));
  std::error_code error;
  if (!fs::equivalent(record.parent_path(), options.run.output, error)) return {};
  return fail(ErrorCode::kInvalidArgument,
              "--replace would remove the recording to be played, `{}`; choose another --output",
              record.string());
}

}  // namespace

Result<int> play(const PlayCommand& options) {
  RAVE_TRY_ASSIGN(const auto played, make(options));
  for (const std::string& note : played.notes) put_note(terminal_of(stderr).yellow("note:"), note);
  if (!options.write.empty()) {
    RAVE_TRY(replay::write_played(played, options.write));
    put(stdout, fmt::format("wrote {0}; run it with `rave run {0}`\n", options.write));
    return kGood;
  }
  RAVE_TRY(keeps_its_record(options));
  RAVE_TRY_ASSIGN(const auto folder, launch::RunFolder::create(
                                         {options.run.output, options.run.replace}, played.name));
  const fs::path scenario = folder.path() / kScenarioFolder;
  std::error_code error;
  if (options.run.replace) fs::remove_all(scenario, error);
  RAVE_TRY(replay::write_played(played, scenario));
  RunCommand run_options = options.run;
  run_options.scenario = scenario.string();
  run_options.output = folder.path().string();
  run_options.replace = false;  // done
  return run(run_options);
}

}  // namespace rave::cli
