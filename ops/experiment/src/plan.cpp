// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "input_digest.hpp"
#include "rave/assemble/build.hpp"
#include "rave/base/file.hpp"
#include "rave/base/named_path.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/config/yaml.hpp"
#include "rave/process/shell_word.hpp"
#include "rave/sim/engine.hpp"

namespace rave::experiment {
namespace {

Result<std::filesystem::path> scenario_of(const config::ExperimentFile& experiment,
                                          const std::filesystem::path& file,
                                          const PlanOptions& options) {
  const auto beside = named_path(file.parent_path(), *experiment.scenario).lexically_normal();
  std::error_code error;
  if (std::filesystem::is_regular_file(beside, error)) return beside;
  auto found = options.find_scenario
                   ? options.find_scenario(*experiment.scenario)
                   : fail(ErrorCode::kNotFound, "there is no scenario `{}`", *experiment.scenario);
  if (found) return found;
  return fail_at(experiment.scenario.where, ErrorCode::kNotFound, "{}", found.error().message);
}

/// Builds conditions, one after the other.
class Planner {
 public:
  Planner(Plan& plan, plugin::Catalogue& catalogue, const PlanOptions& options)
      : plan_(plan),
        catalogue_(catalogue),
        options_(options),
        digest_(options.program, catalogue) {}

  Result<PlannedCondition> plan(Condition condition) {
    PlannedCondition planned;
    planned.condition = std::move(condition);
    RAVE_TRY_ASSIGN(auto scenario,
                    config::expand_scenario(plan_.scenario, planned.condition.settings));
    runtime::BuildOptions how;
    how.program_runner = options_.program_runner;
    RAVE_TRY_ASSIGN(auto built, runtime::build(scenario, catalogue_, how));
    if (!built.live_reason.empty()) {
      return fail(ErrorCode::kInvalidArgument,
                  "the run would be live, and its seed would not decide it: {}", built.live_reason);
    }
    planned.duration_s = scenario.scenario.duration_s.seconds;
    if (scenario.scenario.duration_s.is_open()) {
      return fail(ErrorCode::kInvalidArgument, "`duration_s`: found an open end, expected a time");
    }
    RAVE_TRY_ASSIGN(planned.inputs, digest_.of(std::move(scenario), built.spec, plan_.experiment));
    // Programs and drivers look at what they are given when they start.
    RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(built.spec)));
    if (options_.measure_s > 0 && plan_.pace == 0) RAVE_TRY(measure(*engine, planned.duration_s));
    return planned;
  }

 private:
  Status measure(sim::Engine& engine, double duration_s) {
    using Clock = std::chrono::steady_clock;
    const double step_s = engine.spec().step.seconds();
    const auto began = Clock::now();
    std::chrono::duration<double> passed{};
    double simulated_s = 0;
    do {
      RAVE_TRY(engine.step());
      simulated_s += step_s;
      passed = Clock::now() - began;
    } while (passed.count() < options_.measure_s && simulated_s < duration_s);
    plan_.pace = simulated_s / std::max(passed.count(), 1e-9);
    return {};
  }

  Plan& plan_;
  plugin::Catalogue& catalogue_;
  const PlanOptions& options_;
  InputDigest digest_;
};

/// The place in the experiment file of the setting that an error is about, if it names one.
SourceLocation place_of(const Condition& condition, const Error& error) {
  const std::string text = error.text();
  for (std::size_t i = 0; i < condition.settings.size(); ++i) {
    if (text.find("--set " + condition.settings[i]) != std::string::npos) {
      return condition.places[i];
    }
  }
  return {};
}

}  // namespace

std::vector<PlannedRun> Plan::runs() const {
  std::vector<PlannedRun> runs;
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    for (int r = 0; r < experiment.repetitions; ++r) {
      runs.push_back({c, experiment.first_seed + static_cast<std::uint64_t>(r)});
    }
  }
  return runs;
}

std::string Plan::command(const PlannedRun& run) const {
  std::string line = "rave run " + process::shell_word(*experiment.scenario);
  for (const std::string& setting : conditions[run.condition].condition.settings) {
    line += " --set " + process::shell_word(setting);
  }
  return line + fmt::format(" --seed {}", run.seed);
}

Result<Plan> make_plan(const std::filesystem::path& file, plugin::Catalogue& catalogue,
                       const PlanOptions& options) {
  Plan plan;
  plan.file = file;
  RAVE_TRY_ASSIGN(plan.text, read_file(file, config::kMaxFileBytes));
  RAVE_TRY_ASSIGN(plan.experiment, config::read_experiment_text(plan.text, file.string()));
  RAVE_TRY_ASSIGN(plan.scenario, scenario_of(plan.experiment, file, options));
  std::vector<Condition> conditions = conditions_of(plan.experiment);
  Planner planner(plan, catalogue, options);
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    auto planned = planner.plan(conditions[c]);
    if (planned) {
      plan.conditions.push_back(*std::move(planned));
      continue;
    }
    const Error& error = planned.error();
    return fail_at(place_of(conditions[c], error), error.code, "condition {} of {} ({}): {}", c + 1,
                   conditions.size(), condition_text(plan.experiment, conditions[c]), error.text());
  }
  return plan;
}

}  // namespace rave::experiment
