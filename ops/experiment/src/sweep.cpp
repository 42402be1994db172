// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "rave/base/file.hpp"
#include "rave/base/random.hpp"
#include "rave/base/thread.hpp"
#include "rave/experiment/kept_runs.hpp"
#include "rave/experiment/run_process.hpp"
#include "rave/experiment/run_table.hpp"
#include "sweep_folder.hpp"

namespace rave::experiment {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// With less room than this, a failure of a run says nothing about the run.
constexpr std::uintmax_t kLeastRoom = std::uintmax_t{8} << 20;

bool is_full(const fs::path& folder) {
  std::error_code error;
  const auto space = fs::space(folder, error);
  return !error && space.available < kLeastRoom;
}

/// Several runs at a time, each in a process of its own.
class Workers {
 public:
  using Done = std::function<Status(const PlannedRun&, RunRow, const fs::path&)>;

  /// `done` is called by one thread at a time with each row and the folder of its results.
  Workers(const Plan& plan, const SweepOptions& options, fs::path work, bool record, Done done)
      : plan_(plan),
        options_(options),
        work_(std::move(work)),
        record_(record),
        done_(std::move(done)) {}

  /// Returns when all runs have ended, at the first error, or when `stop` is set.
  Status run(std::vector<PlannedRun> runs) {
    runs_ = std::move(runs);
    std::vector<std::jthread> threads(std::min(options_.jobs, runs_.size()));
    for (std::size_t i = 0; i < threads.size(); ++i) {
      const Status started = start_thread(threads[i], "a sweep", [this, i] { work(i); });
      if (!started) end(started.error());
    }
    threads.clear();
    if (error_) return tl::unexpected(*error_);
    return {};
  }

 private:
  void work(std::size_t worker) {
    RunProcessOptions how;
    how.program = options_.program;
    how.arguments = options_.arguments;
    how.folder = work_ / std::to_string(worker);
    how.record = record_;
    how.stop = [this] { return is_stopped(); };
    while (const auto run = next()) {
      auto row = run_process(plan_, *run, how);
      const std::scoped_lock lock(mutex_);
      if (ended_) return;
      if (!row) return end_locked(row.error());
      if (!*row) return;
      if (!(*row)->failure.empty() && is_full(work_)) {
        return end_locked(
            {ErrorCode::kIo,
             fmt::format("the disk of `{}` is full: {}", work_.string(), (*row)->failure),
             {}});
      }
      const Status done = done_(*run, **std::move(row), how.folder);
      if (!done) return end_locked(done.error());
    }
  }

  std::optional<PlannedRun> next() {
    const std::scoped_lock lock(mutex_);
    if (is_stopped() || next_ == runs_.size()) return std::nullopt;
    return runs_[next_++];
  }
  [[nodiscard]] bool is_stopped() const { return ended_ || (options_.stop && options_.stop()); }
  void end(const Error& error) {
    const std::scoped_lock lock(mutex_);
    end_locked(error);
  }
  void end_locked(const Error& error) {
    if (!error_) error_ = error;
    ended_ = true;
  }

  const Plan& plan_;
  const SweepOptions& options_;
  const fs::path work_;
  const bool record_;
  const Done done_;
  std::mutex mutex_;
  std::vector<PlannedRun> runs_;
  std::size_t next_ = 0;
  std::optional<Error> error_;
  std::atomic<bool> ended_ = false;
};

std::vector<PlannedRun> runs_of(const Plan& plan, const Shard& shard) {
  std::vector<PlannedRun> all = plan.runs();
  std::vector<PlannedRun> own;
  for (std::size_t i = shard.index; i < all.size(); i += shard.count) own.push_back(all[i]);
  return own;
}

const RunRow* row_of(const Plan& plan, const RunRows& rows, const PlannedRun& run) {
  return rows.find(plan.conditions[run.condition].inputs, run.seed);
}

/// Counts what is done, and says how long the rest takes.
class Counting {
 public:
  Counting(const Plan& plan, const std::vector<PlannedRun>& runs, const SweepOptions& options)
      : options_(options), left_(plan.conditions.size(), 0) {
    progress_.runs = runs.size();
    for (const PlannedRun& run : runs) ++left_[run.condition];
  }

  void add(const PlannedRun& run, const RunRow& row) {
    ++progress_.done;
    if (!row.failure.empty()) ++progress_.failed;
    if (--left_[run.condition] == 0) ++progress_.conditions;
  }
  void add_new(const PlannedRun& run, const RunRow& row) {
    add(run, row);
    ++begun_;
    const std::chrono::duration<double> passed = Clock::now() - began_;
    progress_.left_s = passed.count() / static_cast<double>(begun_) *
                       static_cast<double>(progress_.runs - progress_.done);
    if (options_.on_progress) options_.on_progress(progress_);
  }
  [[nodiscard]] const SweepProgress& progress() const { return progress_; }
  [[nodiscard]] std::size_t begun() const { return begun_; }

 private:
  const SweepOptions& options_;
  SweepProgress progress_;
  std::vector<std::size_t> left_;  // runs by condition
  std::size_t begun_ = 0;
  const Clock::time_point began_ = Clock::now();
};

std::size_t count_missing(const Plan& plan, const RunRows& rows) {
  const auto runs = plan.runs();
  return static_cast<std::size_t>(std::ranges::count_if(
      runs, [&](const PlannedRun& run) { return row_of(plan, rows, run) == nullptr; }));
}

}  // namespace

Result<SweepOutcome> sweep(const Plan& plan, const SweepOptions& options) {
  RAVE_TRY_ASSIGN(const auto folder, SweepFolder::open(plan, options));
  SweepOutcome outcome;
  RAVE_TRY_ASSIGN(outcome.rows, RunRows::read(options.folder));
  RAVE_TRY_ASSIGN(auto ledger, Ledger::open(folder.ledger()));
  if (outcome.rows.unreadable() > 0) {
    outcome.notes.push_back(
        fmt::format("{} lines of the ledger cannot be read; their runs are done again",
                    outcome.rows.unreadable()));
  }
  const std::vector<PlannedRun> runs = runs_of(plan, options.shard);
  Counting counting(plan, runs, options);
  std::vector<PlannedRun> missing;
  for (const PlannedRun& run : runs) {
    const RunRow* const row = row_of(plan, outcome.rows, run);
    if (row != nullptr && (row->failure.empty() || !options.retry)) {
      counting.add(run, *row);
    } else {
      missing.push_back(run);
    }
  }
  KeptRuns kept(plan, options.folder);
  Workers workers(plan, options, folder.work(), kept.record(),
                  [&](const PlannedRun& run, RunRow row, const fs::path& results) -> Status {
                    RAVE_TRY(ledger.append(row));
                    outcome.rows.add(row);
                    RAVE_TRY(kept.settle(run, results, outcome.rows));
                    counting.add_new(run, row);
                    return {};
                  });
  const Status worked = workers.run(std::move(missing));
  outcome.progress = counting.progress();
  outcome.begun = counting.begun();
  outcome.missing = count_missing(plan, outcome.rows);
  std::error_code ignored;  // the next sweep removes it
  fs::remove_all(folder.work(), ignored);
  if (options.shard.count == 1) {
    const Status written =
        write_private_file_atomically(options.folder / "runs.csv", run_table(plan, outcome.rows));
    if (worked) RAVE_TRY(written);
  }
  RAVE_TRY(worked);
  return outcome;
}

Result<std::vector<SweepDifference>> repeat_sample(const Plan& plan, const SweepOptions& options,
                                                   std::size_t count, std::uint64_t seed) {
  RAVE_TRY_ASSIGN(const RunRows rows, RunRows::read(options.folder));
  std::vector<PlannedRun> runs = plan.runs();
  std::erase_if(runs, [&](const PlannedRun& run) { return row_of(plan, rows, run) == nullptr; });
  if (runs.empty()) {
    return fail(ErrorCode::kNotFound, "`{}` has no finished run of this experiment",
                options.folder.string());
  }
  RandomStream random(seed, 0, 0, 0);
  count = std::min(count, runs.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto other = random.uniform(static_cast<double>(i), static_cast<double>(runs.size()));
    std::swap(runs[i], runs[std::min(static_cast<std::size_t>(other), runs.size() - 1)]);
  }
  runs.resize(count);
  std::vector<SweepDifference> differences;
  const fs::path work = options.folder / fmt::format("work-repeat-{:016x}", seed);
  RAVE_TRY(create_folder(work));
  Workers workers(plan, options, work, false,
                  [&](const PlannedRun& run, RunRow row, const fs::path&) -> Status {
                    const RunRow& recorded = *row_of(plan, rows, run);
                    row.wall_s = recorded.wall_s;
                    if (!(row == recorded)) differences.push_back({run, recorded, std::move(row)});
                    return {};
                  });
  const Status worked = workers.run(std::move(runs));
  std::error_code ignored;
  fs::remove_all(work, ignored);
  RAVE_TRY(worked);
  return differences;
}

}  // namespace rave::experiment
