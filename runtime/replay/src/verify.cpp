// SPDX-License-Identifier: Apache-2.0
#include "rave/replay/verify.hpp"

#include <unistd.h>

#include <chrono>

#include "host_again.hpp"
#include "played_files.hpp"
#include "rave/assemble/build.hpp"
#include "rave/control/obstacle_edits.hpp"
#include "rave/control/requests.hpp"
#include "rave/pace/stall_watch.hpp"
#include "rave/pace/wall_pace.hpp"
#include "rave/record/merge.hpp"
#include "rave/record/record_summary.hpp"
#include "rave/record/run_reader.hpp"
#include "rave/recording/provenance.hpp"
#include "rave/recording/record_keeper.hpp"
#include "rave/recording/recorded_scenario.hpp"
#include "rave/results/capture_watch.hpp"
#include "record_match.hpp"
#include "recorded_run.hpp"

namespace rave::runtime {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// A temporary folder for the second recording.
class Scratch {
 public:
  [[nodiscard]] static Result<Scratch> create() {
    std::error_code error;
    std::string name = (fs::temp_directory_path(error) / "rave-verify-XXXXXX").string();
    if (error || ::mkdtemp(name.data()) == nullptr) {
      return fail(ErrorCode::kIo, "cannot create a temporary folder `{}`", name);
    }
    return Scratch(name);
  }
  Scratch(Scratch&& other) noexcept : path_(std::exchange(other.path_, {})) {}
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  Scratch& operator=(Scratch&&) = delete;
  ~Scratch() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  [[nodiscard]] const fs::path& folder() const { return path_; }
  [[nodiscard]] fs::path file() const { return path_ / "again.mcap"; }

 private:
  explicit Scratch(fs::path path) : path_(std::move(path)) {}
  fs::path path_;
};

/// The repeated run: all robots in one engine, or one host of several.
struct Again {
  sim::Engine& engine;
  std::function<Status()> step;
  std::function<Result<std::string>(const request::Request&)> ask;
  std::function<std::vector<sim::Event>()> beside;  ///< Events missing in the engine.
  bool looks = false;  ///< The run reports by itself when a step is done.
};

Again again_of(sim::Engine& engine) {
  return {engine, [&engine] { return engine.step(); },
          [&engine](const request::Request& request) { return serve_request(engine, request); },
          [] { return std::vector<sim::Event>(); }};
}

Again again_of(HostAgain& host) {
  return {host.engine(), [&host] { return host.step(); },
          [&host](const request::Request& request) { return host.ask(request); },
          [&host] { return host.beside(); }, true};
}

/// Repeats the recorded requests at the same steps.
class InputReplay {
 public:
  explicit InputReplay(std::vector<record::RunInput> inputs) : inputs_(std::move(inputs)) {}

  /// Makes the requests due before the next step. A refusal is a difference: in the recorded run
  /// they succeeded.
  Status serve(const Again& again, RecordKeeper& keeper, VerifyOutcome& outcome) {
    const std::uint64_t step = again.engine.steps_done();
    // A request counts from the step that was due when it was made, so it is repeated before that
    // step.
    for (; next_ < inputs_.size() && inputs_[next_].step <= step; ++next_) {
      const record::RunInput& input = inputs_[next_];
      RAVE_TRY_ASSIGN(const request::Request request, request_of(input));
      const auto answer = again.ask(request);
      if (answer) {
        // The second recording needs the inputs as well, or it would differ from the first.
        keeper.keep(request, step);
      } else {
        outcome.notes.push_back(
            fmt::format("step {}: `{}` was accepted in the recording and is refused here: {}",
                        input.step, input.kind, answer.error().text()));
      }
    }
    return {};
  }

 private:
  std::vector<record::RunInput> inputs_;
  std::size_t next_ = 0;
};

/// Compares the inputs that are not in the recording itself.
void compare_inputs(const record::RunInfo& run, const RecordedScenario& known,
                    VerifyOutcome& outcome) {
  outcome.notes.insert(outcome.notes.end(), known.notes.begin(), known.notes.end());
  for (const auto& [path, recorded] : run.inputs) {
    // Those that the recording has itself, and maps: the notes above tell of them.
    if (known.scenario.files.all().contains(path)) continue;
    const auto now = sha256_of_file(path);
    if (!now) {
      outcome.missing.push_back(now.error().text());
    } else if (*now != recorded) {
      outcome.notes.push_back(
          fmt::format("the input file `{}` has changed since the recording (SHA-256 {}, now {})",
                      path, recorded, *now));
    }
  }
}

void compare_versions(const record::RunInfo& run, const record::StringMap& now,
                      VerifyOutcome& outcome) {
  for (const auto& [name, recorded] : run.versions) {
    const auto found = now.find(name);
    const std::string version = found == now.end() ? "none" : found->second;
    if (version != recorded) {
      outcome.notes.push_back(fmt::format("{} was version {} in the recording and is {} here", name,
                                          recorded, version));
    }
  }
}

/// Notes the length of the recorded run; of an interrupted one, up to its last complete step.
Status note_length(const record::McapReader& reader, const record::RunInfo& run,
                   const std::optional<record::RunEnd>& end, VerifyOutcome& outcome) {
  if (end) {
    outcome.recorded_steps = end->steps;
    outcome.recorded_hash = end->hash;
    return {};
  }
  const std::int64_t step_ns = from_seconds(run.step_s).ns;
  if (step_ns <= 0) return fail(ErrorCode::kParse, "the recording does not state the step");
  outcome.recorded_steps = static_cast<std::uint64_t>(
      reader.statistics().end_ns / static_cast<std::uint64_t>(step_ns) + 1);
  outcome.partial.emplace_back("the recording breaks off there, before the end of the run");
  return {};
}

/// An interrupted recording is compared up to its end; a damaged one is refused because it proves
/// nothing.
Status check_record(const fs::path& record, VerifyOutcome& outcome) {
  RAVE_TRY_ASSIGN(const record::CheckedFile checked, record::check_record(record));
  if (!checked.damages.empty()) {
    return fail(ErrorCode::kParse, "the recording is damaged, so nothing is compared: {}{}",
                checked.damages.front(),
                checked.damages.size() == 1
                    ? ""
                    : fmt::format(" (and {} more: rave info --check)", checked.damages.size() - 1));
  }
  for (const auto* const texts : {&checked.cuts, &checked.unsummed}) {
    outcome.notes.insert(outcome.notes.end(), texts->begin(), texts->end());
  }
  return {};
}

/// The second run and the writers of its recording.
struct SecondRun {
  const Again& again;
  RecordKeeper& keeper;
  BodyKinds& kinds;
  std::optional<CaptureWatch> capture{};

  void look_back() {
    kinds.learn(again.engine.spec().world);
    keeper.keep(again.engine);
    keeper.keep(again.beside());
    if (!capture) return;
    capture->after_step(again.engine);
    keeper.keep(capture->events());
  }
};

/// Steps until the end of the recorded run, or one step beyond the first one with a different hash:
/// the result of a step appears in the poses of the next.
Status run_again(SecondRun& run, InputReplay inputs, const std::vector<std::uint64_t>& hashes,
                 const VerifyOptions& options, VerifyOutcome& outcome) {
  sim::Engine& engine = run.again.engine;
  StallWatch watch(options.log);
  const auto begin = Clock::now();
  auto next_progress = begin;
  const double step_s = engine.spec().step.seconds();
  bool differs = false;
  while (outcome.steps < outcome.recorded_steps) {
    if (options.control != nullptr && options.control->stopping()) {
      outcome.ended_early = true;
      return {};
    }
    RAVE_TRY(inputs.serve(run.again, run.keeper, outcome));
    watch.step_begins(outcome.steps);
    RAVE_TRY(run.again.step());
    watch.step_ends();
    if (!run.again.looks) run.look_back();
    ++outcome.steps;
    if (differs) return {};
    const std::uint64_t done = outcome.steps - 1;
    differs = done < hashes.size() && hashes[done] != engine.hash().value();
    const auto now = Clock::now();
    if (!options.on_progress || now < next_progress) continue;
    next_progress = now + kProgressInterval;
    const double wall_s = std::chrono::duration<double>(now - begin).count();
    const double sim_s = static_cast<double>(outcome.steps) * step_s;
    const double end_s = static_cast<double>(outcome.recorded_steps) * step_s;
    options.on_progress({sim_s / end_s, sim_s, end_s, wall_s > 0 ? sim_s / wall_s : 0,
                         engine.spec().robots.size(), "comparing"});
  }
  RAVE_TRY(inputs.serve(run.again, run.keeper, outcome));
  outcome.hash = engine.hash().value();
  return {};
}

/// Reports differences that appear in the hash but not in the streams.
void judge_hash(const std::vector<std::uint64_t>& hashes, const sim::Engine& engine,
                VerifyOutcome& outcome) {
  if (outcome.difference || outcome.ended_early) return;
  if (!outcome.hash || !outcome.recorded_hash || *outcome.hash == *outcome.recorded_hash) return;
  const std::uint64_t last = hashes.empty() ? outcome.steps - 1 : hashes.size() - 1;
  outcome.difference = RunDifference{
      last, static_cast<double>(last) * engine.spec().step.seconds(), "", "run hash",
      fmt::format("recorded: {:016x}; now: {:016x}; all streams of the recording are equal",
                  *outcome.recorded_hash, *outcome.hash)};
}

/// What the comparison of the streams has shown. Errors: kInvalidArgument: there was nothing to
/// compare.
Status note_match(const RecordMatch& match, const fs::path& record, VerifyOutcome& outcome) {
  if (match.messages == 0 && !match.difference && !outcome.ended_early) {
    return fail(ErrorCode::kInvalidArgument,
                "`{}` cannot be verified: it contains nothing to compare", record.string());
  }
  for (const std::string& topic : match.absent) {
    outcome.partial.push_back(fmt::format("the recording has no stream `{}`", topic));
  }
  outcome.messages = match.messages;
  outcome.difference = match.difference;
  return {};
}

}  // namespace

Result<VerifyOutcome> verify(const fs::path& record, plugin::Catalogue& catalogue,
                             const VerifyOptions& options) {
  VerifyOutcome outcome;
  RAVE_TRY(check_record(record, outcome));
  RAVE_TRY_ASSIGN(const auto reader, record::McapReader::open(record));
  RAVE_TRY_ASSIGN(const record::RunInfo run, record::read_run_info(reader));
  if (const auto missing = record::missing_parts(reader); !missing.empty()) {
    return fail(ErrorCode::kInvalidArgument,
                "`{}` cannot be verified, because a part of the run is missing: {}",
                record.string(), missing.front());
  }
  RAVE_TRY_ASSIGN(RecordedScenario recorded, recorded_scenario(reader, run, record));
  compare_inputs(run, recorded, outcome);
  if (!outcome.missing.empty()) return outcome;
  RAVE_TRY_ASSIGN(const Scratch scratch, Scratch::create());
  RAVE_TRY(put_played_files(run, scratch.folder(), recorded));
  config::ExpandedScenario& scenario = recorded.scenario;
  if (options.threads > 0) scenario.scenario.threads = static_cast<int>(options.threads);
  WallPace pace(0);
  RAVE_TRY_ASSIGN(BuiltScenario built,
                  build(scenario, catalogue, {options.program_runner, options.log, &pace}));
  outcome.live_reason = built.live_reason;
  const auto end = record::read_run_end(reader);
  if (outcome.live_reason.empty() && end && !end->hash) {
    outcome.live_reason = "the recording states that the run was live";
  }
  if (!outcome.live_reason.empty()) return outcome;
  RAVE_TRY(note_length(reader, run, end, outcome));
  built.spec.live_clock = nullptr;
  BodyKinds kinds(built.spec, built.robot_kinds);
  std::unique_ptr<sim::Engine> alone;
  std::unique_ptr<HostAgain> of_host;
  if (const std::string host = record::host_of(reader); !host.empty()) {
    RAVE_TRY_ASSIGN(of_host, HostAgain::create(scenario, host, catalogue,
                                               {options.program_runner, options.log, &pace}));
  } else {
    RAVE_TRY_ASSIGN(alone, sim::Engine::create(std::move(built.spec)));
  }
  const Again again = of_host ? again_of(*of_host) : again_of(*alone);
  const sim::Engine& engine = again.engine;
  // Other versions are a note and not an error: the comparison shows whether they matter.
  compare_versions(run, versions_of(engine.spec(), catalogue), outcome);
  RAVE_TRY_ASSIGN(const auto hashes, read_hashes(reader));
  RAVE_TRY_ASSIGN(const auto keeper, RecordKeeper::open(scratch.file(), engine, kinds,
                                                        info_of(engine, kinds), {}, options.log));
  RAVE_TRY_ASSIGN(auto inputs, read_inputs(reader));
  SecondRun second{again, *keeper, kinds};
  const auto& checks = scenario.scenario.checks;
  // Captures concern robots of several hosts, so the manager records them and a host does not.
  if (checks.capture && !of_host) second.capture.emplace(*checks.capture, scenario);
  if (of_host) of_host->look = [&second] { second.look_back(); };
  RAVE_TRY(run_again(second, InputReplay(std::move(inputs)), hashes, options, outcome));
  outcome.time_s = static_cast<double>(outcome.steps) * engine.spec().step.seconds();
  RAVE_TRY(keeper->end(engine.hash().value()));
  RAVE_TRY_ASSIGN(const auto written, record::McapReader::open(scratch.file()));
  RAVE_TRY_ASSIGN(const RecordMatch match,
                  match_records(reader, written, run, {!end, record::is_merged(reader)}));
  RAVE_TRY(note_match(match, record, outcome));
  judge_hash(hashes, engine, outcome);
  return outcome;
}

}  // namespace rave::runtime
