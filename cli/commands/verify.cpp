// SPDX-License-Identifier: Apache-2.0
#include "commands/verify.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "console.hpp"
#include "error_text.hpp"
#include "interrupt.hpp"
#include "places.hpp"
#include "rave/replay/verify.hpp"

namespace rave::cli {
namespace {

void tell_difference(const runtime::RunDifference& difference, const Terminal& terminal) {
  const std::string robot =
      difference.robot.empty() ? "" : fmt::format("robot {}, ", difference.robot);
  put(stderr,
      fmt::format("{} first in step {} ({:.3f} s): {}{}\n  {}\n", terminal.red("differs:"),
                  difference.step, difference.time_s, robot, difference.channel, difference.text));
}

Result<int> tell(const VerifyCommand& options, const runtime::VerifyOutcome& outcome) {
  const Terminal errors = terminal_of(stderr);
  if (!outcome.live_reason.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "`{}` cannot be verified: {}, so no two runs are equal", options.file,
                outcome.live_reason);
  }
  for (const std::string& missing : outcome.missing) put_note(errors.red("missing:"), missing);
  if (!outcome.missing.empty()) {
    return fail(ErrorCode::kNotFound, "`{}` cannot be verified without the input files above",
                options.file);
  }
  for (const std::string& note : outcome.notes) put_note(errors.yellow("note:"), note);
  if (outcome.ended_early) {
    put(stderr, fmt::format("{} after {} of {} steps\n", errors.red("stopped:"), outcome.steps,
                            outcome.recorded_steps));
    return kNotGood;
  }
  if (outcome.difference) {
    tell_difference(*outcome.difference, errors);
    return kNotGood;
  }
  if (!outcome.partial.empty()) {
    put(stderr, fmt::format("{} {} steps, {} messages compared and equal, to {:.3f} s: {}\n",
                            errors.red("incomplete:"), outcome.steps, outcome.messages,
                            outcome.time_s, fmt::join(outcome.partial, "; ")));
    return kNotGood;
  }
  if (options.quiet) return kGood;
  const std::string hash =
      outcome.recorded_hash ? fmt::format(", run hash {:016x}", *outcome.recorded_hash) : "";
  put(stdout,
      fmt::format("{} {} steps, {} messages compared{}\n", terminal_of(stdout).green("equal:"),
                  outcome.steps, outcome.messages, hash));
  return kGood;
}

}  // namespace

Result<int> verify(const VerifyCommand& options) {
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue(options.plugins));
  RAVE_TRY_ASSIGN(const auto record, record_file(options.file));
  Console console(options.quiet);
  runtime::VerifyOptions verify_options;
  verify_options.program_runner = program_runner();
  verify_options.threads = static_cast<unsigned>(options.threads.value_or(0));
  verify_options.log = &console;
  verify_options.on_progress = [&](const report::Progress& progress) { console.show(progress); };
  verify_options.control = &ended_by_signals();
  RAVE_TRY_ASSIGN(const auto outcome, runtime::verify(record, *catalogue, verify_options));
  console.clear();
  return tell(options, outcome);
}

}  // namespace rave::cli
