// SPDX-License-Identifier: Apache-2.0
#include "run_conductor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "error_text.hpp"
#include "places.hpp"
#include "rave/base/json_text.hpp"
#include "rave/base/names.hpp"
#include "rave/base/thread.hpp"
#include "rave/record/merge.hpp"
#include "run_people.hpp"
#include "run_plan.hpp"
#include "run_scenario.hpp"

namespace rave::cli {
namespace {

using gui_server::ConductMessage;
using ConductDo = ConductMessage::Do;

constexpr std::chrono::milliseconds kLookAtRun{200};
constexpr std::size_t kLogLines = 40;

std::string how(const process::ChildEnd& end, const std::vector<std::string>& log) {
  if (end.signal) return fmt::format("Its process was killed by signal {}.", *end.signal);
  if (end.exit_code == kGood) return "It completed and its checks hold.";
  if (end.exit_code == kNotGood) return "It did not complete, or a check does not hold.";
  return log.empty() ? "It did not start." : "It did not start: " + log.back();
}

Result<std::shared_ptr<gui_server::Source>> recording_in(const std::filesystem::path& folder) {
  RAVE_TRY_ASSIGN(const auto run, record::open_run(folder));
  return gui_server::open_recording(run.file);
}

}  // namespace

Result<std::shared_ptr<RunConductor>> RunConductor::start(const RunCommand& options,
                                                          gui_server::GuiServer& page) {
  std::shared_ptr<RunConductor> conductor(new RunConductor(options, page));
  conductor->list_ = RunList::read();
  RAVE_TRY(
      start_thread(conductor->thread_, "the runs of the page",
                   [self = conductor.get()](const std::stop_token& stop) { self->work(stop); }));
  page.show(gui_server::no_run());
  page.conduct_by(conductor);
  return conductor;
}

RunConductor::~RunConductor() { close(); }

void RunConductor::close() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

std::uint64_t RunConductor::revision() const {
  const std::lock_guard lock(mutex_);
  return revision_;
}

std::string_view RunConductor::word_of(State state) noexcept {
  constexpr WordTable<State, 5> kWords = {{{"starting", State::kStarting},
                                           {"running", State::kRunning},
                                           {"ending", State::kEnding},
                                           {"ended", State::kEnded},
                                           {"failed", State::kFailed}}};
  return kWords.of(state);
}

bool RunConductor::in_progress() const {
  return told_ && told_->state != State::kEnded && told_->state != State::kFailed;
}

std::string RunConductor::text(bool whole) {
  const std::lock_guard lock(mutex_);
  nlohmann::ordered_json message = {{"type", "conduct"}, {"may", whole}, {"run", nullptr}};
  if (told_) {
    nlohmann::ordered_json& run = message["run"];
    run = {{"scenario", told_->scenario},
           {"state", word_of(told_->state)},
           {"text", told_->text},
           {"number", told_->number}};
    if (whole) {
      if (told_->seed) run["seed"] = *told_->seed;
      run["folder"] = told_->folder;
      run["process"] = told_->process;
      run["log"] = told_->log;
      run["due"] = nlohmann::ordered_json::parse(told_->due);
    }
  }
  if (whole) {
    message["shown"] = shown_;
    message["scenarios"] = nlohmann::ordered_json::parse(list_.scenarios);
    message["recordings"] = nlohmann::ordered_json::parse(list_.recordings);
  }
  return json_text(message);
}

Result<std::string> RunConductor::take(const ConductMessage& message) {
  const std::lock_guard lock(mutex_);
  const bool ends = message.what == ConductDo::kEnd || message.what == ConductDo::kRestart;
  if (ends && !told_) return fail(ErrorCode::kState, "No run was started here.");
  if (message.what == ConductDo::kEnd && !in_progress()) {
    return fail(ErrorCode::kState, "The run of `{}` has ended.", told_->scenario);
  }
  if (!ends && in_progress()) {
    return fail(ErrorCode::kState, "A run of `{}` is in progress. End it first.", told_->scenario);
  }
  if (message.what == ConductDo::kStart) {
    const std::vector<std::string> names = known_scenarios();
    // A name of the list, and no path that a page makes up.
    if (std::find(names.begin(), names.end(), message.name) == names.end()) {
      const std::vector<std::string_view> views(names.begin(), names.end());
      return fail(ErrorCode::kNotFound, "There is no scenario `{}`{}.", message.name,
                  suggestion(message.name, views));
    }
    // At once, so that a second request meanwhile is refused.
    told_ = Told{message.name, std::nullopt, State::kStarting, "", "", ++starts_};
    ++revision_;
  }
  if (message.what == ConductDo::kOpen) RAVE_TRY(folder_of_recording(message.name));
  messages_.push_back(message);
  asked_.notify_all();
  switch (message.what) {
    case ConductDo::kStart:
      return fmt::format("{} starts.", message.name);
    case ConductDo::kEnd:
      return fmt::format("The run of {} ends.", told_->scenario);
    case ConductDo::kRestart:
      return fmt::format("{} starts again.", told_->scenario);
    case ConductDo::kOpen:
      return fmt::format("{} is opened.", message.name);
    case ConductDo::kClose:
      break;
  }
  return std::string("The page shows what can be started.");
}

void RunConductor::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::optional<ConductMessage> message;
    {
      std::unique_lock lock(mutex_);
      asked_.wait_for(lock, stop, kLookAtRun, [this] { return !messages_.empty(); });
      if (!messages_.empty()) {
        message = std::move(messages_.front());
        messages_.pop_front();
      }
    }
    if (message) obey(*message);
    if (run_) look_after();
  }
  run_.reset();
}

void RunConductor::obey(const ConductMessage& message) {
  switch (message.what) {
    case ConductDo::kStart:
      return begin(message.name, message.seed);
    case ConductDo::kEnd:
    case ConductDo::kRestart:
      again_ = message.what == ConductDo::kRestart;
      again_seed_ = message.seed;
      if (run_) {
        run_->end();
        return tell([this] { told_->state = State::kEnding; });
      }
      if (again_) begin_again();
      return;
    case ConductDo::kOpen:
      if (const auto folder = folder_of_recording(message.name)) show_recording(*folder);
      return;
    case ConductDo::kClose:
      page_.show(gui_server::no_run());
      return tell([this] { shown_.clear(); });
  }
}

void RunConductor::begin_again() {
  std::string name;
  std::optional<std::uint64_t> seed = again_seed_;
  {
    const std::lock_guard lock(mutex_);
    name = told_->scenario;
    if (!seed) seed = told_->seed;
  }
  begin(name, seed);
}

void RunConductor::begin(const std::string& name, std::optional<std::uint64_t> seed) {
  again_ = false;
  tell([&] {
    const bool known = told_ && told_->scenario == name && told_->state == State::kStarting;
    told_ = Told{name, seed, State::kStarting, "", "", known ? told_->number : ++starts_};
    shown_.clear();
  });
  RunCommand options = options_;
  options.scenario = name;
  options.seed = seed;
  options.on_bus = true;
  if (const Status begun = begin_process(options); !begun) {
    run_.reset();
    page_.show(gui_server::no_run());
    console_.error("gui", "{}", begun.error().text());
    tell([&] {
      told_->state = State::kFailed;
      told_->text = begun.error().text();
    });
  }
}

Status RunConductor::begin_process(const RunCommand& options) {
  RAVE_TRY_ASSIGN(const auto scenario, read_scenario(options));
  PageOptions page = options.page;
  RAVE_TRY_ASSIGN(const auto people, RunPeople::of(scenario, page));
  RAVE_TRY_ASSIGN(run_, ConductedRun::start(options, scenario, page_, console_));
  RAVE_TRY(people->invite(page_));
  put(stdout, fmt::format("{} runs in {}\n", options.scenario, run_->folder().string()));
  std::fflush(stdout);
  tell([&] {
    told_->state = State::kRunning;
    told_->seed = scenario.scenario.seed;
    told_->folder = run_->folder().string();
    told_->process = run_->process();
    told_->due = due_json(scenario);
  });
  return {};
}

void RunConductor::look_after() {
  auto log = run_->log_lines(kLogLines);
  bool other = false;
  {
    const std::lock_guard lock(mutex_);
    other = log != told_->log;
  }
  if (other) tell([&] { told_->log = std::move(log); });
  if (const auto end = run_->wait(std::chrono::milliseconds(0))) note_end(*end);
}

void RunConductor::note_end(const process::ChildEnd& end) {
  const auto log = run_->log_lines(kLogLines);
  const std::filesystem::path folder = run_->folder();
  run_.reset();
  if (!again_) show_recording(folder);
  RunList list = RunList::read();
  tell([&] {
    const bool good = end.exit_code == kGood || end.exit_code == kNotGood;
    told_->state = good ? State::kEnded : State::kFailed;
    told_->text = how(end, log);
    told_->process = 0;
    told_->log = log;
    list_ = std::move(list);
  });
  put(stdout, fmt::format("the run has ended. {}\n", how(end, log)));
  std::fflush(stdout);
  if (again_) begin_again();
}

void RunConductor::show_recording(const std::filesystem::path& folder) {
  auto replay = recording_in(folder);
  if (!replay) {
    page_.show(gui_server::no_run());
    return tell([&] { shown_.clear(); });
  }
  page_.show(*std::move(replay));
  tell([&] { shown_ = folder.filename().string(); });
}

}  // namespace rave::cli
