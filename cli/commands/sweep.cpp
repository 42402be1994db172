// SPDX-License-Identifier: Apache-2.0
#include "commands/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <random>
#include <string_view>

#include "error_text.hpp"
#include "experiment_plan.hpp"
#include "interrupt.hpp"
#include "places.hpp"
#include "rave/base/number.hpp"
#include "rave/experiment/slurm.hpp"
#include "rave/experiment/sweep.hpp"
#include "terminal.hpp"

namespace rave::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFailures = 5;  // that are shown

Result<experiment::Shard> shard_of(std::string_view word) {
  experiment::Shard shard;
  if (word.empty()) return shard;
  const std::size_t slash = word.find('/');
  if (slash != std::string_view::npos) {
    const auto index = number_of<std::size_t>(word.substr(0, slash));
    const auto count = number_of<std::size_t>(word.substr(slash + 1));
    if (index && count && *index >= 1 && *index <= *count) {
      return experiment::Shard{*index - 1, *count};
    }
  }
  return fail(ErrorCode::kInvalidArgument,
              "--shard: found `{}`, expected I/N with I from 1 to N, such as 1/4", word);
}

/// One line that is redrawn on a terminal, and a plain line from time to time elsewhere.
class ProgressLine {
 public:
  explicit ProgressLine(const SweepCommand& options)
      : quiet_(options.quiet), terminal_(terminal_of(stderr)) {}

  void show(const experiment::SweepProgress& progress, std::size_t conditions) {
    const auto now = Clock::now();
    const bool last = progress.done == progress.runs;
    if (quiet_ || (now < next_ && !last)) return;
    next_ =
        now + (terminal_.is_terminal ? std::chrono::milliseconds(200) : std::chrono::seconds(10));
    const std::string failed =
        progress.failed == 0 ? "" : fmt::format(", {} failed", progress.failed);
    const std::string left = last ? "" : fmt::format(", {} left", wall_time_text(progress.left_s));
    const std::string line =
        fmt::format("{} of {} runs, {} of {} conditions{}{}", progress.done, progress.runs,
                    progress.conditions, conditions, failed, left);
    put(stderr, terminal_.is_terminal ? "\r\033[K" + line : line + "\n");
    drawn_ = terminal_.is_terminal;
  }
  void clear() const {
    if (drawn_) put(stderr, "\r\033[K");
  }

 private:
  using Clock = std::chrono::steady_clock;
  const bool quiet_;
  const Terminal terminal_;
  Clock::time_point next_;
  bool drawn_ = false;
};

/// Why runs failed, and how to see it again.
void tell_failures(const experiment::Plan& plan, const experiment::RunRows& rows) {
  std::size_t shown = 0;
  for (const experiment::PlannedRun& run : plan.runs()) {
    const auto* const row = rows.find(plan.conditions[run.condition].inputs, run.seed);
    if (row == nullptr || row->failure.empty()) continue;
    if (++shown > kMostFailures) continue;
    put_note(terminal_of(stderr).red("failed:"),
             fmt::format("{}, seed {}: {}\n  {}", plan.text_of(run.condition), run.seed,
                         row->failure, plan.command(run)));
  }
  if (shown > kMostFailures) {
    put(stderr, fmt::format("  and {} more; all are in runs.csv\n", shown - kMostFailures));
  }
}

Result<int> repeat(const experiment::Plan& plan, const experiment::SweepOptions& how,
                   const SweepCommand& options) {
  std::random_device random;
  RAVE_TRY_ASSIGN(const auto differences,
                  experiment::repeat_sample(plan, how, *options.verify, random()));
  if (how.stop()) return put(stderr, "stopped\n"), kNotGood;
  for (const auto& difference : differences) {
    put_note(terminal_of(stderr).red("differs:"),
             fmt::format("{}, seed {}: hash {} recorded, {} now\n  {}",
                         plan.text_of(difference.run.condition), difference.run.seed,
                         difference.recorded.hash, difference.repeated.hash,
                         plan.command(difference.run)));
  }
  if (!differences.empty()) return kNotGood;
  if (!options.quiet) put(stdout, terminal_of(stdout).green("equal") + "\n");
  return kGood;
}

int tell(const experiment::Plan& plan, const experiment::SweepOptions& how,
         const experiment::SweepOutcome& outcome, const SweepCommand& options) {
  const experiment::SweepProgress& progress = outcome.progress;
  for (const std::string& note : outcome.notes) {
    put_note(terminal_of(stderr).yellow("note:"), note);
  }
  if (progress.failed > 0) tell_failures(plan, outcome.rows);
  if (progress.done < progress.runs) {
    put(stderr, fmt::format("stopped after {} of {} runs; the same command continues\n",
                            progress.done, progress.runs));
    return kNotGood;
  }
  if (!options.quiet) {
    const std::string failed =
        progress.failed == 0 ? "" : fmt::format(", {} failed", progress.failed);
    put(stdout, fmt::format("{} runs, {} of them now{}\n", progress.runs, outcome.begun, failed));
    if (how.shard.count > 1 && outcome.missing > 0) {
      put(stdout, fmt::format("{} runs of the other shards are missing; `rave sweep` without "
                              "--shard makes the table\n",
                              outcome.missing));
    } else if (how.shard.count == 1) {
      put(stdout, fmt::format("{}: runs.csv\n", how.folder.string()));
    }
  }
  return progress.failed == 0 ? kGood : kNotGood;
}

}  // namespace

Result<int> sweep(const SweepCommand& options) {
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue(options.plugins));
  RAVE_TRY_ASSIGN(const fs::path file, find_experiment(options.experiment));
  runtime::RunControl& control = ended_by_signals();
  RAVE_TRY_ASSIGN(const auto plan, load_plan(file, *catalogue, 0));
  ProgressLine line(options);
  experiment::SweepOptions how;
  how.program = executable_folder() / "rave";
  how.folder = options.output.empty() ? fs::path("sweeps") / *plan.experiment.name
                                      : fs::path(options.output);
  how.jobs = options.jobs.value_or(usable_cores());
  for (const std::string& folder : options.plugins) {
    how.arguments.insert(how.arguments.end(), {"--plugins", folder});
  }
  how.retry = options.retry;
  how.stop = [&control] { return control.stopping(); };
  RAVE_TRY_ASSIGN(how.shard, shard_of(options.shard));
  if (options.verify) return repeat(plan, how, options);
  how.on_progress = [&](const experiment::SweepProgress& progress) {
    line.show(progress, plan.conditions.size());
  };
  const auto outcome =
      options.slurm ? experiment::sweep_on_slurm(plan, how, {*options.slurm, options.slurm_options})
                    : experiment::sweep(plan, how);
  line.clear();
  if (!outcome) return tl::unexpected(outcome.error());
  return tell(plan, how, *outcome, options);
}

}  // namespace rave::cli
