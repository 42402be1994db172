// SPDX-License-Identifier: Apache-2.0
#include "run_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>

#include "rave/base/json_text.hpp"
#include "rave/codec/nodes.hpp"
#include "rave/config/people_file.hpp"
#include "rave/gui_server/rights.hpp"

namespace rave::cli {
namespace {

std::string join(const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
  return line;
}

std::string trigger_of(const config::ChangeFile& change) {
  if (change.at_s) return fmt::format("at {:g} s", **change.at_s);
  if (change.every_s) return fmt::format("every {:g} s", **change.every_s);
  const std::string later =
      *change.delay_s > 0 ? fmt::format(", {:g} s later", *change.delay_s) : "";
  if (change.after) return fmt::format("after `{}`{}", **change.after, later);
  return fmt::format("{} {}{}", change.repeat ? "each time that" : "when", **change.when, later);
}

std::string text_of(const config::ChangeFile& change) {
  if (change.end) {
    return fmt::format("the run ends as a {}",
                       *change.end == config::RunVerdict::kSuccess ? "success" : "failure");
  }
  if (change.give) {
    return fmt::format("team `{}` is given to `{}`", *change.give->team, *change.give->to);
  }
  if (change.mark) return fmt::format("mark \"{}\"", *change.mark);
  if (change.request) return codec::to_json_line(*change.request);
  if (!change.obstacle.empty()) return config::write_edit(change.obstacle);
  if (change.hand_over) return fmt::format("`{}` is handed over", **change.robot);
  std::vector<std::string> values;
  for (std::size_t i = 0; i < change.set->size(); ++i) {
    values.push_back(
        fmt::format("{} = {}", change.set->key(i), codec::to_json_line(change.set->child(i))));
  }
  return fmt::format("`{}`: {}", **change.robot, join(values));
}

/// Of equal times the order of the file is the order of the changes; conditions come last.
std::vector<const config::ChangeFile*> by_time(const config::ScenarioFile& scenario) {
  std::vector<const config::ChangeFile*> changes;
  for (const config::ChangeFile& change : scenario.changes) changes.push_back(&change);
  std::ranges::stable_sort(
      changes, {}, [](const auto* change) { return change->at_s ? **change->at_s : HUGE_VAL; });
  return changes;
}

class Plan {
 public:
  Plan(const RunCommand& options, const config::ExpandedScenario& scenario,
       const runtime::BuiltScenario& built)
      : options_(options), scenario_(scenario), file_(scenario.scenario), built_(built) {}

  std::string text(const std::vector<config::PlannedHost>& hosts) && {
    const std::string length =
        file_.duration_s.is_open() ? "open end" : fmt::format("{:g} s", file_.duration_s.seconds);
    line("scenario `{}`: {}, step {:g} s, seed {}, {}", *file_.name, length, *file_.step_s,
         file_.seed,
         built_.live_reason.empty() ? "pace " + to_string(file_.pace)
                                    : "in real time (" + built_.live_reason + ")");
    line("processes:");
    processes(hosts);
    line("people:");
    people();
    line("what happens:");
    events();
    return std::move(text_);
  }

 private:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_ += '\n';
  }

  void processes(const std::vector<config::PlannedHost>& hosts) {
    const std::string page = options_.gui ? " and the page" : "";
    for (const config::CompanionFile& companion : file_.companions) {
      line("  companion `{}`: {}", *companion.name, fmt::join(*companion.command, " "));
    }
    if (hosts.empty()) {
      std::vector<std::size_t> all(scenario_.robots.size());
      std::iota(all.begin(), all.end(), 0);
      return line("  this process{}: {}", page, robots_text(all));
    }
    line("  this process: Environment Manager{}", page);
    for (const config::PlannedHost& host : hosts) {
      line("  host `{}`, {}: {}", host.name,
           host.elsewhere ? "which you start" : "which this process starts",
           robots_text(host.robots));
    }
  }

  /// The name of the entry that a robot was written in.
  [[nodiscard]] const std::string& family(std::size_t robot) const {
    const config::RobotGroup& group = scenario_.group_of(scenario_.robots[robot]);
    return group.part_of.empty() ? group.name.value : group.part_of;
  }

  [[nodiscard]] bool is_real(std::size_t robot) const {
    return !built_.spec.types[built_.spec.robots[robot].type].simulated;
  }

  /// Robots of one entry that follow each other are one item.
  [[nodiscard]] std::string robots_text(const std::vector<std::size_t>& robots) const {
    std::vector<std::string> items;
    for (std::size_t begin = 0; begin < robots.size();) {
      const config::ExpandedRobot& first = scenario_.robots[robots[begin]];
      std::size_t end = begin + 1;
      const bool real = is_real(robots[begin]);
      while (end < robots.size() && family(robots[end]) == family(robots[begin]) &&
             is_real(robots[end]) == real) {
        ++end;
      }
      const config::ExpandedRobot& last = scenario_.robots[robots[end - 1]];
      const std::string names = end - begin == 1
                                    ? fmt::format("`{}`", first.name)
                                    : fmt::format("`{}` to `{}`", first.name, last.name);
      items.push_back(names + (real ? " (real)" : ""));
      begin = end;
    }
    return fmt::format("{} robot{}: {}", robots.size(), robots.size() == 1 ? "" : "s", join(items));
  }

  void people() {
    for (const config::PlannedPerson& person : config::plan_people(scenario_)) {
      const std::string teams = !person.teams ? "all teams"
                                : person.teams->empty()
                                    ? "no team"
                                    : fmt::format("{}", fmt::join(*person.teams, ", "));
      line("  `{}`, {}: {}", person.name, role(person.role), teams);
    }
    if (file_.gui.rights.empty()) line("  the rights of their roles");
    for (const config::GuiRightFile& right : file_.gui.rights) {
      std::vector<std::string> classes;
      for (const auto what : right.classes) classes.emplace_back(gui_server::to_string(what));
      line("  {}: {} of {}", who(right), join(classes), reach(right));
    }
  }

  static std::string_view role(config::UserRole role) {
    switch (role) {
      case config::UserRole::kObserver:
        return "observer";
      case config::UserRole::kCommander:
        return "commander";
      case config::UserRole::kSuperUser:
        return "super-user";
    }
    return "";
  }

  static std::string who(const config::GuiRightFile& right) {
    if (right.user) return fmt::format("user `{}`", right.user->value);
    return right.role == config::GuiRole::kCommander ? "commanders" : "observers";
  }

  static std::string reach(const config::GuiRightFile& right) {
    if (right.reach != config::GuiReach::kTeams) {
      return std::string(gui_server::kReaches.of(right.reach)) + " robots";
    }
    std::vector<std::string> teams;
    for (const auto& team : right.teams) teams.push_back(*team);
    return "teams " + join(teams);
  }

  void events() {
    for (const config::ChangeFile* change : by_time(file_)) {
      line("  {}: {}", trigger_of(*change), text_of(*change));
    }
    if (file_.script) line("  each step: `{}`", **file_.script);
    if (file_.checks.capture && file_.checks.capture->end_run) {
      line("  when `{}` catches `{}`: the run ends", *file_.checks.capture->predator,
           *file_.checks.capture->prey);
    }
    if (file_.duration_s.is_open()) return line("  at Ctrl-C or `rave end`: the run ends");
    line("  at {:g} s: the run ends", file_.duration_s.seconds);
  }

  const RunCommand& options_;
  const config::ExpandedScenario& scenario_;
  const config::ScenarioFile& file_;
  const runtime::BuiltScenario& built_;
  std::string text_;
};

}  // namespace

std::string run_plan(const RunCommand& options, const config::ExpandedScenario& scenario,
                     const std::vector<config::PlannedHost>& hosts,
                     const runtime::BuiltScenario& built) {
  return Plan(options, scenario, built).text(hosts);
}

std::string due_json(const config::ExpandedScenario& scenario) {
  nlohmann::ordered_json due = nlohmann::ordered_json::array();
  for (const config::ChangeFile* change : by_time(scenario.scenario)) {
    due.push_back(
        {{"name", change->name}, {"trigger", trigger_of(*change)}, {"text", text_of(*change)}});
    if (change->at_s) due.back()["at_s"] = **change->at_s;
  }
  return json_text(due);
}

}  // namespace rave::cli
