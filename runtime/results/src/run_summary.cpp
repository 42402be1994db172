// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include "rave/base/names.hpp"
#include "rave/base/table.hpp"
#include "rave/results/capture_watch.hpp"
#include "rave/results/outcome.hpp"
#include "rave/results/result_parts.hpp"
#include "rave/results/sighting_check.hpp"

namespace rave::runtime {
namespace {

void add_guard_row(const RunResults& results, Table& table) {
  std::map<std::string, std::size_t> total;
  for (const auto& [robot, counts] : guard_counts(results)) {
    for (const auto& [what, count] : counts) total[what] += count;
  }
  std::string text;
  for (const auto& [what, count] : total) {
    const std::size_t space = what.find(' ');
    text += fmt::format("{}{} {}x{}", text.empty() ? "" : ", ", what.substr(0, space), count,
                        what.substr(space));
  }
  if (!text.empty()) table.rows.push_back({"guard", text});
}

void add_capture_rows(const RunResults& results, Table& table) {
  if (!results.scenario.scenario.checks.capture) return;
  if (!results.facts.capture) {
    table.rows.push_back({"captured", "not evaluated: no host saw all of the robots"});
    return;
  }
  const sim::EngineSpec& spec = results.spec;
  const CaptureFacts& capture = *results.facts.capture;
  for (const Capture& caught : capture.captures) {
    std::string text = fmt::format("{} by {} at {:.2f} s", spec.robots[caught.prey.value()].name,
                                   spec.robots[caught.predator.value()].name, caught.time_s);
    for (const RobotId robot : lost_poses(caught, results.facts.events, spec.step)) {
      text += fmt::format("; the pose of {} was lost", spec.robots[robot.value()].name);
    }
    table.rows.push_back({"captured", std::move(text)});
  }
  if (!capture.captures.empty()) return;
  const double closest_m = capture.closest_m.value_or(std::numeric_limits<double>::infinity());
  table.rows.push_back({"captured", fmt::format("none; nearest {:.2f} m", closest_m)});
}

void add_sighting_row(const RunResults& results, Table& table) {
  if (!results.scenario.scenario.checks.sightings) return;
  const config::SightingsCheckFile& limits = *results.scenario.scenario.checks.sightings;
  const SightingFacts facts = results.facts.sightings.value_or(SightingFacts());
  const SightingTally tally = facts.all();
  const bool holds = runtime::holds(limits, tally) && !results.any_lost();
  std::vector<std::string_view> blind;
  for (const auto& [robot, own] : facts.by_robot) {
    // A robot whose camera saw nothing at all has confirmed nothing, which the percentage alone
    // would hide.
    if (own.total + own.unknown == 0) blind.emplace_back(robot);
  }
  table.rows.push_back(
      {"sighting check",
       fmt::format(
           "{}: {:.2f} % of {} real sightings agree with the virtual camera ({} with "
           "unknown codes){}",
           holds ? "holds" : "FAILS", within_pct(limits, tally), counted(limits, tally),
           tally.unknown,
           blind.empty() ? std::string() : fmt::format("; none of {}", join_names(blind)))});
}

/// The real robots whose commands had no effect, as `a, b and c`.
std::string disobedient(const RunResults& results) {
  std::vector<std::string_view> names;
  for (const RobotFacts& robot : results.facts.robots) {
    if (robot.commands > 0 && !robot.obeys) {
      names.emplace_back(results.spec.robots[robot.robot].name);
    }
  }
  return names.empty() ? std::string() : join_names(names);
}

void add_encounter_rows(const RunResults& results, Table& table) {
  for (const auto& [pair, encounter] : results.facts.closest) {
    table.rows.push_back(
        {fmt::format("closest {}", pair),
         fmt::format("{:.3f} m between outlines at {:.2f} s ({} and {})",
                     // Outlines that overlap have a negative distance, which says nothing to a
                     // reader of the summary.
                     std::max(encounter.gap_m, 0.0), encounter.time_s,
                     results.kinds.name(encounter.a), results.kinds.name(encounter.b))});
  }
}

void add_hit_rows(const RunResults& results, Table& table) {
  for (const auto& [who, counts] : results.facts.hits) {
    std::string text;
    for (const auto& [what, count] : counts) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", what, count);
    }
    table.rows.push_back({fmt::format("rays of {} robots met", who), text});
  }
}

/// How long changes of the world took to the robots of all hosts, in real time.
void add_delay_rows(const RunResults& results, Table& table) {
  if (!results.edits) return;
  const auto add = [&table](const char* what, std::uint64_t count, double sum_s, double slowest_s) {
    if (count == 0) return;
    table.rows.push_back({fmt::format("{} to other hosts", what),
                          fmt::format("{} after {:.3f} s, the slowest after {:.3f} s", count,
                                      sum_s / static_cast<double>(count), slowest_s)});
  };
  const PoseDelayFacts& poses = results.facts.poses;
  add("poses", poses.count, 1e-9 * static_cast<double>(poses.sum_ns),
      1e-9 * static_cast<double>(poses.slowest_ns));
  add("edits", results.edits->confirmed, results.edits->sum_s, results.edits->slowest_s);
}

/// What users have to know beside the results, the hash and the problems.
void add_notes(const RunResults& results, const RunOutcome& outcome, Table& table) {
  const std::string deaf = disobedient(results);
  if (!deaf.empty()) {
    table.rows.push_back(
        {"ignored commands", deaf + ": recorded robots ignore them; the commands were logged"});
  }
  for (const HostShare& host : results.hosts) {
    if (host.found || !host.folders.empty()) continue;
    table.rows.push_back(
        {fmt::format("host {}", host.name),
         "on another machine: its results are there, in the folder of its `rave robot`"});
  }
  table.rows.push_back(
      {"run hash", outcome.hash.empty() ? "none: " + why_no_hash(results, outcome) : outcome.hash});
  for (const std::string& problem : outcome.problems) table.rows.push_back({"problem", problem});
}

}  // namespace

std::string summary_text(const RunResults& results, const RunOutcome& outcome) {
  Table table;
  table.title = results.scenario.scenario.name.value;
  table.columns = {{"what", Align::kLeft, false}, {"result", Align::kLeft, true}};
  const std::size_t count = results.spec.robots.size();
  const std::size_t real = results.real_robots();
  const double simulated_s = results.done_s();
  table.rows.push_back(
      {"robots", fmt::format("{}: {} real, {} simulated", count, real, count - real)});
  table.rows.push_back(
      {"time", fmt::format("{:.2f} s simulated in {:.2f} s ({:.1f}x)", simulated_s, results.wall_s,
                           simulated_s / std::max(results.wall_s, 1e-9))});
  if (outcome.ended_by_hand_s) {
    table.rows.push_back({"ended by hand", fmt::format("at {:.2f} s", *outcome.ended_by_hand_s)});
  }
  if (const LatenessFacts& late = results.facts.lateness; late.deadlines > 0) {
    table.rows.push_back({"deadlines", lateness_text(late)});
  }
  add_sighting_row(results, table);
  const auto goals = goal_results(results.scenario, results.spec, results.facts, results.lost,
                                  results.ended_by_hand);
  for (const CheckResult& check : goals) {
    table.rows.push_back(
        {check.name, fmt::format("{}: {}", check.holds ? "holds" : "FAILS", check.text)});
  }
  table.rules_before.push_back(table.rows.size());
  add_encounter_rows(results, table);
  table.rules_before.push_back(table.rows.size());
  add_hit_rows(results, table);
  table.rules_before.push_back(table.rows.size());
  table.rows.push_back(
      {"contacts, pinned robots", fmt::format("{}, {}", results.count(sim::EventKind::kContact),
                                              results.count(sim::EventKind::kPinned))});
  if (results.facts.world_from > 0) {
    table.rows.push_back(
        {"",
         fmt::format(
             "and captures, from step {} on: the earlier ones were lost with the previous manager",
             results.facts.world_from)});
  }
  add_delay_rows(results, table);
  if (has_radio(results.spec)) {
    table.rows.push_back({"messages", radio_line(results.facts.radio)});
  }
  add_guard_row(results, table);
  add_capture_rows(results, table);
  if (const auto by_hand = results.facts.inputs_by_hand; by_hand > 0) {
    table.rows.push_back(
        {"changed by people",
         fmt::format("{} inputs; the scenario without them gives another run", by_hand)});
  }
  add_notes(results, outcome, table);
  return render_table(table, {100, false});
}

}  // namespace rave::runtime
