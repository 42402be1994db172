// SPDX-License-Identifier: Apache-2.0
#include "rave/replay/branch.hpp"

#include <fmt/format.h>

#include <cmath>
#include <future>
#include <utility>

#include "played_files.hpp"
#include "rave/base/file.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/record/merge.hpp"
#include "rave/record/run_reader.hpp"
#include "rave/recording/recorded_scenario.hpp"
#include "recorded_run.hpp"

namespace rave::runtime {
namespace {

/// Compares the hashes up to the branch, and asks the run for what people asked and for what is
/// different. Requests are posted between two steps, by the thread of the run, so that each counts
/// from the step that it had.
class BranchWatch final : public RunObserver {
 public:
  BranchWatch(std::uint64_t at_step, std::vector<std::uint64_t> hashes,
              std::vector<record::RunInput> inputs, const BranchOptions& options)
      : at_step_(at_step),
        hashes_(std::move(hashes)),
        inputs_(std::move(inputs)),
        options_(options),
        control_(*options.run.control) {}

  void after_step(const StepView& step) override {
    const std::uint64_t done = step.engine.steps_done();
    if (done <= at_step_ && !outcome.differs_at) {
      if (step.engine.hash().value() == hashes_[done - 1]) {
        ++outcome.compared;
      } else {
        outcome.differs_at = done - 1;
        control_.stop();
      }
    }
    ask(done);
  }

  /// The run begins paused, so that requests before its first step have their turn.
  void held(const sim::Engine& engine) override {
    if (engine.steps_done() == 0 && !begun_) ask(0);
    begun_ = true;
    control_.resume();
  }

  /// After the run: what it refused.
  void collect() {
    for (auto& [text, answer] : answers_) {
      const auto result = answer.get();
      if (!result) outcome.refused.push_back(text + ": " + result.error().message);
    }
  }

  BranchOutcome outcome;

 private:
  /// What counts from the next step, whose number is `step`, on.
  void ask(std::uint64_t step) {
    for (; next_ < inputs_.size() && inputs_[next_].step <= step; ++next_) {
      const record::RunInput& input = inputs_[next_];
      // What people asked for the step of the branch itself is later than it.
      if (input.step >= at_step_ && !options_.with_people) continue;
      auto request = request_of(input);
      if (request) {
        post(*std::move(request));
      } else {
        outcome.refused.push_back(request.error().text());
      }
    }
    if (step != at_step_) return;
    for (request::Request request : options_.requests) {
      request.by = "branch";
      post(std::move(request));
    }
  }

  void post(request::Request request) {
    std::string text = request::to_json_line(request);
    auto posted = control_.post(std::move(request));
    if (posted) {
      answers_.emplace_back(std::move(text), *std::move(posted));
    } else {
      outcome.refused.push_back(text + ": " + posted.error().message);
    }
  }

  const std::uint64_t at_step_;
  const std::vector<std::uint64_t> hashes_;
  const std::vector<record::RunInput> inputs_;
  const BranchOptions& options_;
  RunControl& control_;
  std::vector<std::pair<std::string, std::future<Result<std::string>>>> answers_;
  std::size_t next_ = 0;
  bool begun_ = false;
};

Status check_parent(const record::McapReader& reader, const std::filesystem::path& record,
                    const std::optional<record::RunEnd>& end) {
  const auto refuse = [&](std::string_view why) {
    return fail(ErrorCode::kInvalidArgument, "`{}` cannot be branched: {}", record.string(), why);
  };
  if (end && !end->hash) return refuse("the run was live, so it cannot be repeated");
  if (!record::host_of(reader).empty()) {
    return refuse("it has one host of several; expected the folder of the whole run");
  }
  if (const auto missing = record::missing_parts(reader); !missing.empty()) {
    return refuse("a part of the run is missing: " + missing.front());
  }
  return {};
}

/// What the recording of a branch says of where it comes from.
std::string origin(const std::filesystem::path& record, const BranchOptions& options,
                   const std::optional<record::RunEnd>& end) {
  std::string text = fmt::format("Branch at {:g} s of {}", options.at_s, record.string());
  if (end && end->hash) text += fmt::format(" (run hash {:016x})", *end->hash);
  for (const request::Request& request : options.requests) {
    text += "; " + request::to_json_line(request);
  }
  return text;
}

}  // namespace

Result<BranchOutcome> branch(const std::filesystem::path& record, plugin::Catalogue& catalogue,
                             const BranchOptions& options) {
  RAVE_TRY_ASSIGN(const auto reader, record::McapReader::open(record));
  RAVE_TRY_ASSIGN(const record::RunInfo info, record::read_run_info(reader));
  const auto end = record::read_run_end(reader);
  RAVE_TRY(check_parent(reader, record, end));
  RAVE_TRY_ASSIGN(auto hashes, read_hashes(reader));
  const auto at_step = static_cast<std::uint64_t>(std::llround(options.at_s / info.step_s));
  if (at_step > hashes.size()) {
    return fail(ErrorCode::kInvalidArgument, "--at {:g}: `{}` has {} steps of {:g} s, to {:g} s",
                options.at_s, record.string(), hashes.size(), info.step_s,
                static_cast<double>(hashes.size()) * info.step_s);
  }
  RAVE_TRY_ASSIGN(auto inputs, read_inputs(reader));
  RAVE_TRY_ASSIGN(RecordedScenario recorded, recorded_scenario(reader, info, record));
  RAVE_TRY(create_folder(options.run.output));
  RAVE_TRY(put_played_files(info, options.run.output, recorded));
  config::ScenarioFile& scenario = recorded.scenario.scenario;
  scenario.hosts.clear();
  scenario.processes.reset();
  scenario.pace = config::Pace{0};
  if (options.until_s) scenario.duration_s = *options.until_s;
  const std::string from = origin(record, options, end);
  scenario.description += scenario.description.empty() ? from : ". " + from;
  BranchWatch watch(at_step, std::move(hashes), std::move(inputs), options);
  RunOptions how = options.run;
  how.observers.push_back(&watch);
  how.control->pause();
  RAVE_TRY_ASSIGN(watch.outcome.run, run(recorded.scenario, catalogue, how));
  watch.collect();
  return std::move(watch.outcome);
}

}  // namespace rave::runtime
