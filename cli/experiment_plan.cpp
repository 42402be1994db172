// SPDX-License-Identifier: Apache-2.0
#include "experiment_plan.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "places.hpp"
#include "rave/base/table.hpp"
#include "terminal.hpp"

namespace rave::cli {
namespace {

constexpr double kMeasure_s = 0.3;
/// The start and end of a process, in seconds.
constexpr double kOverhead_s = 0.03;
constexpr std::size_t kMostConditions = 40;

std::string plan_table(const experiment::Plan& plan) {
  Table table;
  table.columns = {{"condition", Align::kRight}};
  for (const auto& factor : plan.experiment.factors) {
    table.columns.push_back(
        {*factor.name + (factor.unit.empty() ? "" : ", " + factor.unit), Align::kRight, true});
  }
  const std::size_t shown = std::min(plan.conditions.size(), kMostConditions);
  for (std::size_t c = 0; c < shown; ++c) {
    std::vector<TableCell> row = {{std::to_string(c + 1)}};
    for (const std::string& level : plan.conditions[c].condition.levels) row.emplace_back(level);
    table.rows.push_back(std::move(row));
  }
  TableOptions options;
  const Terminal terminal = terminal_of(stdout);
  options.ansi = terminal.colour;
  if (terminal.is_terminal) options.width = terminal.width;
  options.look = TableLook::kSpaces;
  options.indent = 2;
  std::string text = render_table(table, options);
  if (shown < plan.conditions.size()) {
    text += fmt::format("  and {} more\n", plan.conditions.size() - shown);
  }
  return text;
}

double expected_wall_s(const experiment::Plan& plan) {
  double simulated_s = 0;
  for (const auto& condition : plan.conditions) simulated_s += condition.duration_s;
  const double runs = static_cast<double>(plan.conditions.size());
  const double one_core =
      plan.experiment.repetitions * (simulated_s / plan.pace + runs * kOverhead_s);
  return one_core / static_cast<double>(usable_cores());
}

}  // namespace

std::size_t usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return static_cast<std::size_t>(std::max(CPU_COUNT(&set), 1));
}

std::string wall_time_text(double seconds) {
  const auto whole = static_cast<long>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

Result<experiment::Plan> load_plan(const std::filesystem::path& file, plugin::Catalogue& catalogue,
                                   double measure_s) {
  experiment::PlanOptions options;
  options.program = executable_folder() / "rave";
  options.program_runner = program_runner();
  options.find_scenario = [](const std::string& name) { return find_scenario(name); };
  options.measure_s = measure_s;
  return experiment::make_plan(file, catalogue, options);
}

Status check_experiment(const std::filesystem::path& file, plugin::Catalogue& catalogue) {
  RAVE_TRY_ASSIGN(const auto plan, load_plan(file, catalogue, kMeasure_s));
  const Terminal terminal = terminal_of(stdout);
  const std::size_t runs = plan.runs().size();
  put(stdout, fmt::format("{}: {}: experiment with {} conditions of {} runs each, {} in all\n",
                          terminal.bold(file.string()), terminal.green("ok"),
                          plan.conditions.size(), plan.experiment.repetitions, runs));
  if (!plan.experiment.question.empty()) {
    put(stdout, fmt::format("  question: {}\n", plan.experiment.question));
  }
  put(stdout, plan_table(plan));
  put(stdout,
      fmt::format("  seeds {} to {}, the same in every condition\n", plan.experiment.first_seed,
                  plan.experiment.first_seed +
                      static_cast<std::uint64_t>(plan.experiment.repetitions - 1)));
  put(stdout, fmt::format("  at most about {} on {} cores, {:.1f} MB without recordings\n",
                          wall_time_text(expected_wall_s(plan)), usable_cores(),
                          static_cast<double>(runs) * 1e-3));
  return {};
}

}  // namespace rave::cli
