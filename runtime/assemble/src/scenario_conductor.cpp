// SPDX-License-Identifier: Apache-2.0
// The entries of `changes:` with a condition, and the script of a scenario. All that it remembers
// is one value, which another process continues from.
#include "scenario_conductor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rave/script/script.hpp"
#include "rave/script/value.hpp"
#include "scenario_requests.hpp"
#include "script_world.hpp"

namespace rave::runtime {
namespace {

using config::ChangeFile;
using script::Value;

/// The events of one step are read by people.
constexpr std::size_t kMostNotes = 100;

/// One entry of `changes:`.
struct Entry {
  std::string name;  ///< As people know it.
  bool noted = false;
  std::optional<std::uint64_t> at_step;
  std::uint64_t every_steps = 0;
  std::uint64_t delay_steps = 0;
  std::optional<std::size_t> after;      ///< Index of the entry.
  std::optional<std::size_t> condition;  ///< Of the script.
  bool repeat = false;
  std::vector<sim::WorldInput> inputs;
  std::vector<std::string> gifts;  ///< Texts of events EventKind::kTeamGiven.
  std::optional<std::string> mark;
  std::optional<config::RunVerdict> end;
};

/// What an entry remembers.
struct Past {
  std::int64_t times = 0;       ///< How often it has happened.
  std::int64_t after_seen = 0;  ///< Of these times of the entry before, it knows.
  std::int64_t due = -1;        ///< The step in which it will happen; -1: none.
  bool holds = false;           ///< The condition held in the last step.
  bool broken = false;          ///< The condition failed, and is not asked again.
};

std::vector<std::string> robots_of(const config::ExpandedScenario& scenario) {
  std::vector<std::string> names;
  for (const config::ExpandedRobot& robot : scenario.robots) names.push_back(robot.name);
  return names;
}

class ScenarioConductor final : public sim::Conductor {
 public:
  explicit ScenarioConductor(const config::ExpandedScenario& scenario)
      : scenario_(names_in(scenario)), world_(robots_of(scenario), scenario.scenario.seed) {}

  Status open(const config::ScenarioFile& file, const sim::EngineSpec& spec);

  void begin() override;
  void decide(const sim::WorldLook& world, sim::Conducted& conducted) override;
  [[nodiscard]] bool ended() const noexcept override { return verdict_.has_value(); }
  [[nodiscard]] std::optional<std::string> failure() const override {
    if (verdict_ != config::RunVerdict::kFailure) return std::nullopt;
    return "the scenario ended the run as a failure" + (why_.empty() ? why_ : ": " + why_);
  }
  [[nodiscard]] std::vector<std::byte> state() const override;
  [[nodiscard]] Status resume(std::span<const std::byte> state) override;

 private:
  using Arguments = std::span<const Value>;
  [[nodiscard]] std::vector<script::Provided> functions();
  [[nodiscard]] Result<Value> act(std::string_view action, Arguments arguments);
  [[nodiscard]] Result<Value> mark(Arguments arguments);
  [[nodiscard]] Result<Value> finish(Arguments arguments);
  [[nodiscard]] Result<Value> give(Arguments arguments);
  [[nodiscard]] Result<Value> happened(Arguments arguments) const;
  [[nodiscard]] Status check_acting() const;
  Status add(const ChangeFile& file, const std::vector<ChangeFile>& all,
             const sim::EngineSpec& spec);
  [[nodiscard]] std::uint64_t steps(double time_s) const {
    return static_cast<std::uint64_t>(std::llround(time_s / scenario_.scenario.step_s.value));
  }
  void look_at(std::size_t index, std::int64_t step);
  [[nodiscard]] bool begins_to_hold(const Entry& entry, Past& past);
  void happen(std::size_t index);
  void call(const char* hook, Arguments arguments);
  void note(std::string text, sim::EventKind kind = sim::EventKind::kScenario);
  void end(config::RunVerdict verdict, std::string why);

  config::ExpandedScenario scenario_;  ///< Of it the names: see names_in().
  ScriptWorld world_;
  std::unique_ptr<script::Script> script_;
  Value first_memory_;
  std::vector<Entry> entries_;
  std::vector<Past> pasts_;
  sim::Conducted* conducted_ = nullptr;  ///< During decide().
  bool acting_ = false;                  ///< A hook is called, not a condition.
  bool hooks_broken_ = false;
  std::optional<config::RunVerdict> verdict_;
  std::string why_;
};

Status ScenarioConductor::open(const config::ScenarioFile& file, const sim::EngineSpec& spec) {
  const std::string name = file.script ? **file.script : "script_source";
  RAVE_TRY_ASSIGN(script_,
                  script::Script::load(file.script_source.value_or(""), name, functions()));
  first_memory_ = script_->memory();
  for (const ChangeFile& change : file.changes) {
    // Errors of the change itself are at its place, as far as that is known.
    const Status added = add(change, file.changes, spec);
    if (added) continue;
    Error error = added.error();
    const SourceLocation at = change.request ? change.request->where()
                              : change.when  ? change.when->where
                              : change.robot ? change.robot->where
                                             : SourceLocation();
    if (error.where.file.empty()) error.where = at;
    return tl::unexpected(std::move(error));
  }
  pasts_.resize(entries_.size());
  // Each step tells it to all hosts. The script may fill its memory later.
  if (state().size() + script::Limits().memory_bytes > kMostState) {
    return fail(ErrorCode::kInvalidArgument,
                "{} entries of `changes` are more than a scenario with conditions or a script can "
                "have",
                entries_.size());
  }
  return {};
}

Status ScenarioConductor::add(const ChangeFile& file, const std::vector<ChangeFile>& all,
                              const sim::EngineSpec& spec) {
  Entry& entry = entries_.emplace_back();
  entry.noted = !file.name.empty() || file.when;
  entry.name = !file.name.empty() ? file.name : file.when ? **file.when : "";
  // What is due at a time is made by others, but `after` may name it.
  if (file.at_s) entry.at_step = steps(**file.at_s);
  if (file.every_s) entry.every_steps = steps(**file.every_s);
  entry.delay_steps = steps(*file.delay_s);
  entry.repeat = file.repeat;
  if (file.when) {
    // The time as a variable, and the end of a line for a comment.
    RAVE_TRY_ASSIGN(entry.condition,
                    script_->compile("(function(t) return " + **file.when + "\n end)(time())",
                                     file.when->where));
  }
  if (file.after) {
    const auto before = std::ranges::find(all, **file.after, &ChangeFile::name);
    entry.after = static_cast<std::size_t>(before - all.begin());
  }
  entry.mark = file.mark;
  if (file.give) entry.gifts = gifts_of(scenario_, *file.give->team, *file.give->to);
  entry.end = file.end;
  if (file.is_scheduled()) {
    entry.noted = false;
    return {};
  }
  RAVE_TRY_ASSIGN(entry.inputs, inputs_of(scenario_, spec, file));
  return {};
}

std::vector<script::Provided> ScenarioConductor::functions() {
  std::vector<script::Provided> all = world_.functions();
  all.push_back({"happened", [this](Arguments arguments) { return happened(arguments); }});
  all.push_back({"mark", [this](Arguments arguments) { return mark(arguments); }});
  all.push_back({"give", [this](Arguments arguments) { return give(arguments); }});
  all.push_back({"finish", [this](Arguments arguments) { return finish(arguments); }});
  for (const std::string_view action : {"stop", "release", "arm", "set", "edit", "drive", "goal",
                                        "path", "cancel", "text", "place"}) {
    all.push_back({std::string(action),
                   [this, action](Arguments arguments) { return act(action, arguments); }});
  }
  return all;
}

Status ScenarioConductor::check_acting() const {
  if (acting_) return {};
  return fail(ErrorCode::kState,
              "only on_start() and on_step() may change something; a condition only looks");
}

Result<Value> ScenarioConductor::act(std::string_view action, Arguments arguments) {
  RAVE_TRY(check_acting());
  RAVE_TRY_ASSIGN(const auto request,
                  request_of(action, arguments.empty() ? Value() : arguments[0]));
  RAVE_TRY_ASSIGN(auto inputs, inputs_of(scenario_, world_.world()->spec(), request));
  std::ranges::move(inputs, std::back_inserter(conducted_->inputs));
  return Value();
}

Result<Value> ScenarioConductor::mark(Arguments arguments) {
  RAVE_TRY(check_acting());
  const std::string* const text = arguments.empty() ? nullptr : arguments[0].text();
  note(text != nullptr ? *text : to_text(arguments.empty() ? Value() : arguments[0]));
  return Value();
}

Result<Value> ScenarioConductor::give(Arguments arguments) {
  RAVE_TRY(check_acting());
  const Value nothing;
  RAVE_TRY_ASSIGN(const auto gifts,
                  gifts_of(scenario_, arguments.empty() ? nothing : arguments[0]));
  for (const std::string& gift : gifts) note(gift, sim::EventKind::kTeamGiven);
  return Value();
}

Result<Value> ScenarioConductor::finish(Arguments arguments) {
  RAVE_TRY(check_acting());
  const std::string* const verdict = arguments.empty() ? nullptr : arguments[0].text();
  if (verdict == nullptr || (*verdict != "success" && *verdict != "failure")) {
    return fail(ErrorCode::kInvalidArgument, "`finish`: expected \"success\" or \"failure\"");
  }
  const std::string* const why = arguments.size() > 1 ? arguments[1].text() : nullptr;
  end(*verdict == "success" ? config::RunVerdict::kSuccess : config::RunVerdict::kFailure,
      why != nullptr ? *why : "");
  return Value();
}

Result<Value> ScenarioConductor::happened(Arguments arguments) const {
  const std::string* const name = arguments.empty() ? nullptr : arguments[0].text();
  const auto entry =
      name == nullptr ? entries_.end() : std::ranges::find(entries_, *name, &Entry::name);
  if (entry == entries_.end() || name->empty()) {
    return fail(ErrorCode::kNotFound, "`happened`: expected the name of an entry of `changes`");
  }
  return Value(pasts_[static_cast<std::size_t>(entry - entries_.begin())].times);
}

void ScenarioConductor::begin() {
  std::ranges::fill(pasts_, Past());
  static_cast<void>(script_->set_memory(first_memory_));
  hooks_broken_ = false;
  verdict_.reset();
  why_.clear();
}

void ScenarioConductor::decide(const sim::WorldLook& world, sim::Conducted& conducted) {
  conducted_ = &conducted;
  world_.show(&world);
  const auto step = static_cast<std::int64_t>(world.step());
  for (std::size_t i = 0; i < entries_.size() && !ended(); ++i) look_at(i, step);
  const Value now(world.now().seconds());
  if (step == 0) call("on_start", {});
  call("on_step", {&now, 1});
  world_.show(nullptr);
  conducted_ = nullptr;
}

/// In the order of the file, so that an entry after another one happens in the same step.
void ScenarioConductor::look_at(std::size_t index, std::int64_t step) {
  const Entry& entry = entries_[index];
  Past& past = pasts_[index];
  const auto now = static_cast<std::uint64_t>(step);
  const auto delay = static_cast<std::int64_t>(entry.delay_steps);
  if (entry.at_step == now) past.due = step;
  if (entry.every_steps > 0 && step > 0 && now % entry.every_steps == 0) past.due = step;
  if (entry.condition && past.due < 0 && (entry.repeat || past.times == 0) &&
      begins_to_hold(entry, past)) {
    past.due = step + delay;
  }
  if (entry.after && pasts_[*entry.after].times > past.after_seen) {
    past.after_seen = pasts_[*entry.after].times;
    past.due = step + delay;
  }
  if (past.due != step) return;
  past.due = -1;
  ++past.times;
  happen(index);
}

bool ScenarioConductor::begins_to_hold(const Entry& entry, Past& past) {
  if (past.broken) return false;
  const auto value = script_->evaluate(*entry.condition);
  if (!value) {
    past.broken = true;
    // Without its place: a recording, which has the scenario in another file, says the same.
    note(
        fmt::format("{}: {}; the condition is not asked again", entry.name, value.error().message));
    return false;
  }
  const bool held = std::exchange(past.holds, value->holds());
  return past.holds && !held;
}

void ScenarioConductor::happen(std::size_t index) {
  const Entry& entry = entries_[index];
  if (entry.noted) note(entry.name);
  conducted_->inputs.insert(conducted_->inputs.end(), entry.inputs.begin(), entry.inputs.end());
  if (entry.end) return end(*entry.end, entry.mark.value_or(""));
  for (const std::string& gift : entry.gifts) note(gift, sim::EventKind::kTeamGiven);
  if (entry.mark) note(*entry.mark);
}

void ScenarioConductor::call(const char* hook, Arguments arguments) {
  if (hooks_broken_ || ended() || !script_->defines(hook)) return;
  // All that a hook asks for is done, or nothing of it.
  const std::size_t inputs = conducted_->inputs.size();
  const std::size_t notes = conducted_->notes.size();
  acting_ = true;
  const auto result = script_->call(hook, arguments);
  acting_ = false;
  if (result) return;
  conducted_->inputs.resize(inputs);
  conducted_->notes.resize(notes);
  verdict_.reset();
  hooks_broken_ = true;
  note(fmt::format("{}; the script is not called again", result.error().text()));
}

void ScenarioConductor::note(std::string text, sim::EventKind kind) {
  if (conducted_->notes.size() < kMostNotes) conducted_->notes.push_back({kind, std::move(text)});
}

void ScenarioConductor::end(config::RunVerdict verdict, std::string why) {
  verdict_ = verdict;
  why_ = std::move(why);
  note(fmt::format("the run ends: {}{}",
                   verdict == config::RunVerdict::kSuccess ? "success" : "failure",
                   why_.empty() ? why_ : ": " + why_));
}

Value list_of(std::vector<Value> values) {
  Value::Table table;
  for (Value& value : values) {
    table.push_back({static_cast<std::int64_t>(table.size() + 1), std::move(value)});
  }
  return {std::move(table)};
}

std::vector<std::byte> ScenarioConductor::state() const {
  std::vector<Value> pasts;
  for (const Past& past : pasts_) {
    pasts.push_back(list_of({past.times, past.after_seen, past.due, past.holds, past.broken}));
  }
  const std::int64_t verdict = verdict_ ? 1 + static_cast<std::int64_t>(*verdict_) : 0;
  return write_value(
      list_of({list_of(std::move(pasts)), script_->memory(), hooks_broken_, verdict, why_}));
}

Status ScenarioConductor::resume(std::span<const std::byte> state) {
  const auto wrong = [] {
    return fail(ErrorCode::kParse, "this is not the state of the conditions of this scenario");
  };
  RAVE_TRY_ASSIGN(const Value all, script::read_value(state));
  const auto part = [](const Value& list, std::int64_t number) {
    const Value* const found = list.find(number);
    return found != nullptr ? *found : Value();
  };
  const auto whole = [&](const Value& list, std::int64_t number) {
    const Value value = part(list, number);
    const auto* const it = std::get_if<std::int64_t>(&value.is);
    return it != nullptr ? *it : 0;
  };
  const Value pasts = part(all, 1);
  const Value why = part(all, 5);
  const std::int64_t verdict = whole(all, 4);
  if (pasts.table() == nullptr || pasts.table()->size() != pasts_.size() || verdict < 0 ||
      verdict > 2 || why.text() == nullptr) {
    return wrong();
  }
  RAVE_TRY(script_->set_memory(part(all, 2)));
  for (std::size_t i = 0; i < pasts_.size(); ++i) {
    const Value& past = (*pasts.table())[i].value;
    pasts_[i] = {whole(past, 1), whole(past, 2), whole(past, 3), part(past, 4).holds(),
                 part(past, 5).holds()};
  }
  hooks_broken_ = part(all, 3).holds();
  verdict_.reset();
  if (verdict > 0) verdict_ = static_cast<config::RunVerdict>(verdict - 1);
  why_ = *why.text();
  return {};
}

}  // namespace

Status add_conductor(const config::ExpandedScenario& scenario, sim::EngineSpec& spec) {
  const config::ScenarioFile& file = scenario.scenario;
  const bool conducts =
      file.script_source ||
      std::ranges::any_of(file.changes, [](const auto& one) { return !one.is_scheduled(); });
  if (!conducts) return {};
  auto conductor = std::make_shared<ScenarioConductor>(scenario);
  RAVE_TRY(conductor->open(file, spec));
  spec.conductor = std::move(conductor);
  return {};
}

}  // namespace rave::runtime
