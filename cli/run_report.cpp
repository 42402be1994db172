// SPDX-License-Identifier: Apache-2.0
#include "run_report.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>

#include "error_text.hpp"
#include "rave/base/control_characters.hpp"

namespace rave::cli {
namespace {

/// The files that a run leaves and that people look at, in that order.
std::string files_of(const std::filesystem::path& folder) {
  constexpr std::array<std::string_view, 11> kFiles = {
      "summary.txt", "result.json", "picture.svg", "picture.png", "events.log", "scenario.yaml",
      "console.log", "run.mcap",    "world.mcap",  "hosts",       "companions"};
  std::string text;
  std::error_code error;
  for (const std::string_view file : kFiles) {
    if (!std::filesystem::exists(folder / file, error)) continue;
    text += (text.empty() ? "" : ", ") + std::string(file);
  }
  return fmt::format("{}: {}\n", folder.string(), text);
}

}  // namespace

int report_outcome(const RunCommand& options, runtime::RunOutcome outcome,
                   const std::filesystem::path& folder, Console& console) {
  if (std::string lost = console.lost_messages(); !lost.empty()) {
    outcome.whole = false;
    outcome.problems.push_back(std::move(lost));
  }
  const bool good = outcome.good();
  if (!options.quiet) {
    put(stdout, outcome.summary);
    if (!outcome.summary.empty() && outcome.summary.back() != '\n') put(stdout, "\n");
    put(stdout, files_of(folder));
  }
  const Terminal errors = terminal_of(stderr);
  for (const std::string& problem : outcome.problems) {
    put_note(good ? errors.yellow("note:") : errors.red("problem:"),
             without_control_characters(problem, " "));
  }
  if (!good) {
    const std::string_view what =
        outcome.whole ? "a check of the scenario does not hold" : "the run did not complete";
    put_note(errors.red("FAILED:"), what);
  } else if (!options.quiet) {
    const std::string how = outcome.ended_by_hand_s
                                ? fmt::format("ended by hand at {:.2f} s", *outcome.ended_by_hand_s)
                                : std::string("done");
    put(stdout, terminal_of(stdout).green(how) + "\n");
  }
  return good ? kGood : kNotGood;
}

}  // namespace rave::cli
