// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/slurm.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <sstream>
#include <string_view>

#include "rave/base/file.hpp"
#include "rave/base/number.hpp"
#include "rave/process/child.hpp"
#include "rave/process/shell_word.hpp"

namespace rave::experiment {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostMessage = 4096;

Result<std::string> program_in_path(const std::string& name) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = folder + "/" + name;
    if (::access(file.c_str(), X_OK) == 0) return file;
  }
  return fail(ErrorCode::kNotFound, "--slurm: there is no `{}` in PATH; expected Slurm's commands",
              name);
}

/// A job array of Slurm, from its submission to its end.
class Job {
 public:
  Job(const Plan& plan, const SweepOptions& options, const SlurmOptions& slurm)
      : plan_(plan), options_(options), slurm_(slurm), folder_(fs::absolute(options.folder)) {}

  /// Submits it and waits until all tasks have ended, well or not.
  Status run(const std::function<void()>& watch) {
    RAVE_TRY_ASSIGN(const std::string sbatch, program_in_path("sbatch"));
    const fs::path said = folder_ / "sbatch.log";
    Descriptor messages(::open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
    if (!messages) return fail(ErrorCode::kIo, "cannot write `{}`", said.string());
    process::ChildOptions how;
    how.words = {sbatch,
                 "--parsable",
                 "--wait",
                 fmt::format("--array=1-{}", slurm_.tasks),
                 "--job-name=rave-" + *plan_.experiment.name,
                 "--output=" + (folder_ / "slurm-%a.log").string()};
    how.words.insert(how.words.end(), slurm_.options.begin(), slurm_.options.end());
    how.words.push_back("--wrap=" + command());
    how.files = {{messages.get(), 1}, {messages.get(), 2}};
    how.no_input = true;
    how.own_group = true;
    RAVE_TRY_ASSIGN(auto child, process::Child::start(how));
    while (!child.wait(std::chrono::milliseconds(500))) {
      watch();
      if (!options_.stop || !options_.stop()) continue;
      cancel(read_file(said, kMostMessage).value_or(""));
      child.kill();
      return {};
    }
    const std::string text = read_file(said, kMostMessage).value_or("");
    if (id_of(text)) return {};
    return fail(ErrorCode::kIo, "Slurm refuses the job: {}", text.substr(0, text.find('\n')));
  }

 private:
  /// What each task does.
  [[nodiscard]] std::string command() const {
    std::vector<std::string> words = {fs::absolute(options_.program),
                                      "sweep",
                                      fs::absolute(plan_.file),
                                      "--output",
                                      folder_,
                                      "--quiet"};
    words.insert(words.end(), options_.arguments.begin(), options_.arguments.end());
    std::string line = "exec";
    for (const std::string& word : words) line += " " + process::shell_word(word);
    return line + fmt::format(
                      " --shard \"$SLURM_ARRAY_TASK_ID/{}\" --jobs "
                      "\"${{SLURM_CPUS_PER_TASK:-1}}\"",
                      slurm_.tasks);
  }

  /// The number at the front of what `sbatch --parsable` prints.
  static std::optional<std::uint64_t> id_of(const std::string& text) {
    return number_of<std::uint64_t>(std::string_view(text).substr(0, text.find_first_of(";\n")));
  }

  static void cancel(const std::string& text) {
    const auto id = id_of(text);
    const auto scancel = program_in_path("scancel");
    if (!id || !scancel) return;
    process::ChildOptions how;
    how.words = {*scancel, std::to_string(*id)};
    how.no_input = true;
    if (auto child = process::Child::start(how)) {
      static_cast<void>(child->wait(std::chrono::seconds(30)));
    }
  }

  const Plan& plan_;
  const SweepOptions& options_;
  const SlurmOptions& slurm_;
  const fs::path folder_;
};

std::size_t count_missing_runs(const Plan& plan, const RunRows& rows) {
  const auto runs = plan.runs();
  return static_cast<std::size_t>(std::ranges::count_if(runs, [&](const PlannedRun& run) {
    return rows.find(plan.conditions[run.condition].inputs, run.seed) == nullptr;
  }));
}

}  // namespace

Result<SweepOutcome> sweep_on_slurm(const Plan& plan, const SweepOptions& options,
                                    const SlurmOptions& slurm) {
  // Nothing is run here: the files of the folder, and in the end its table.
  SweepOptions here = options;
  here.stop = [] { return true; };
  here.on_progress = nullptr;
  RAVE_TRY_ASSIGN(SweepOutcome outcome, sweep(plan, here));
  const std::size_t missing_at_first = outcome.missing;
  while (outcome.missing > 0 && !(options.stop && options.stop())) {
    const std::size_t before = outcome.missing;
    const auto watch = [&] {
      const auto rows = RunRows::read(options.folder);
      if (!rows || !options.on_progress) return;
      SweepProgress progress;
      progress.runs = plan.runs().size();
      progress.done = progress.runs - count_missing_runs(plan, *rows);
      options.on_progress(progress);
    };
    RAVE_TRY(Job(plan, options, slurm).run(watch));
    // Tasks that were cancelled may take a moment to let go of the folder.
    if (options.stop && options.stop()) break;
    RAVE_TRY_ASSIGN(outcome, sweep(plan, here));
    if (outcome.missing == before) {
      return fail(ErrorCode::kState,
                  "the job array has ended without a new run; `{}` has what its tasks said",
                  (options.folder / "slurm-1.log").string());
    }
  }
  outcome.begun = missing_at_first - outcome.missing;
  return outcome;
}

}  // namespace rave::experiment
