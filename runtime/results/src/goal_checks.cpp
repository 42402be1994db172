// SPDX-License-Identifier: Apache-2.0
#include "rave/results/goal_checks.hpp"

#include <algorithm>
#include <cmath>

namespace rave::runtime {
namespace {

std::string listed(const std::vector<codec::Located<std::string>>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + *name;
  return text;
}

bool contains(const std::vector<RobotId>& robots, RobotId robot) {
  return std::find(robots.begin(), robots.end(), robot) != robots.end();
}

/// The robots of an entry, without duplicates.
std::vector<RobotId> robots_of(const config::ExpandedScenario& scenario,
                               const config::TouchesCheckFile& file) {
  std::vector<RobotId> robots;
  for (const auto& name : file.robots) {
    for (const RobotId robot : named_robots(scenario, *name)) {
      if (!contains(robots, robot)) robots.push_back(robot);
    }
  }
  return robots;
}

}  // namespace

std::vector<RobotId> named_robots(const config::ExpandedScenario& scenario, std::string_view name) {
  std::vector<RobotId> ids;
  for (const std::size_t r : config::robots_named(scenario, name)) {
    ids.emplace_back(static_cast<std::uint32_t>(r));
  }
  return ids;
}

GoalChecks::GoalChecks(const config::ExpandedScenario& scenario, const sim::EngineSpec& spec) {
  for (const config::TouchesCheckFile& file : scenario.scenario.checks.touches) {
    Touches touches;
    for (const RobotId robot : robots_of(scenario, file)) {
      const auto& sensors = spec.types[spec.robots[robot.value()].type].sensors;
      for (std::uint32_t s = 0; file.sensor && s < sensors.size(); ++s) {
        if (sensors[s].name == **file.sensor) touches.feelers.push_back({robot, s});
      }
    }
    touches_.push_back(std::move(touches));
  }
  for (const config::ArrivalCheckFile& file : scenario.scenario.checks.arrivals) {
    for (const RobotId robot : named_robots(scenario, *file.robot)) {
      arrivals_.push_back({file, robot, {}});
    }
  }
}

void GoalChecks::count_readings(const sim::Engine& engine, Touches& touches) {
  for (Feeler& feeler : touches.feelers) {
    feeler.here = engine.is_local(feeler.robot);
    if (!feeler.here) continue;
    const sim::SensorSample sample = engine.sensor(feeler.robot, feeler.sensor);
    if (sample.info->kind != ReadingKind::kContact || sample.header->count == 0) continue;
    feeler.heard = true;
    const auto* first = static_cast<const ContactReading*>(sample.records);
    const bool touching = std::any_of(first, first + sample.header->count,
                                      [](const ContactReading& c) { return c.touching != 0; });
    // A touch counts when it begins. A reading that stays "touching" is the same touch.
    if (touching && !feeler.touching) ++touches.count;
    feeler.touching = touching;
  }
}

void GoalChecks::after_step(const StepView& step) {
  const sim::Engine& engine = step.engine;
  for (Touches& touches : touches_) count_readings(engine, touches);
  for (Arrival& arrival : arrivals_) {
    ArrivalFacts& facts = arrival.facts;
    if (!engine.is_local(arrival.id)) continue;
    const sim::ReportedPose& pose = engine.reported(arrival.id);
    // The reported pose, not the true one: the check is the same for real and simulated robots.
    if (!pose.known || facts.time_s) continue;
    const double off_m =
        std::hypot(pose.pose.x_m - arrival.file.x_m, pose.pose.y_m - arrival.file.y_m);
    facts.nearest_m = facts.known ? std::min(facts.nearest_m, off_m) : off_m;
    facts.known = true;
    const double now_s = engine.time().seconds();
    if (off_m <= arrival.file.within_m && now_s <= arrival.file.before_s.value_or(now_s)) {
      facts.time_s = now_s;
    }
  }
}

GoalFacts GoalChecks::facts() const {
  GoalFacts facts;
  for (const Touches& touches : touches_) {
    facts.touches.push_back(touches.count);
    std::vector<std::uint32_t>& silent = facts.silent.emplace_back();
    for (const Feeler& feeler : touches.feelers) {
      if (feeler.here && !feeler.heard) silent.push_back(feeler.robot.value());
    }
  }
  for (const Arrival& arrival : arrivals_) facts.arrivals.push_back(arrival.facts);
  return facts;
}

namespace {

/// Only the robot that pushes has the event, but the robot that is pushed was touched as well.
std::uint64_t count_contacts(const sim::EngineSpec& spec, const std::vector<sim::Event>& events,
                             const std::vector<RobotId>& robots) {
  const auto first_robot = static_cast<std::uint32_t>(spec.world.obstacles.size());
  const auto concerned = [&](const sim::Event& event) {
    if (event.kind != sim::EventKind::kContact) return false;
    return contains(robots, event.robot) ||
           std::any_of(robots.begin(), robots.end(), [&](RobotId robot) {
             return BodyId(first_robot + robot.value()) == event.other;
           });
  };
  return static_cast<std::uint64_t>(std::count_if(events.begin(), events.end(), concerned));
}

CheckResult touches_result(const config::TouchesCheckFile& file, std::uint64_t count) {
  const auto& [robots, sensor, most, least] = file;
  CheckResult result;
  result.name = fmt::format("touches of {}{}", listed(robots),
                            sensor ? fmt::format(" (by `{}`)", **sensor) : std::string());
  const auto counted = static_cast<std::int64_t>(count);
  result.holds = counted >= least && counted <= most;
  result.text = least > 0 ? fmt::format("{}, expected {} to {}", count, least, most)
                          : fmt::format("{}, expected at most {}", count, most);
  return result;
}

CheckResult arrival_result(const config::ArrivalCheckFile& file, const std::string& robot,
                           const ArrivalFacts& facts) {
  CheckResult result;
  result.name = fmt::format("{} comes to ({:.2f}, {:.2f}) m", robot, file.x_m, file.y_m);
  result.holds = facts.time_s.has_value();
  const std::string limit =
      file.before_s ? fmt::format(" before {} s", *file.before_s) : std::string();
  if (facts.time_s) {
    result.text = fmt::format("at {:.2f} s", *facts.time_s);
  } else if (facts.known) {
    result.text = fmt::format("came no nearer than {:.2f} m, expected {} m{}", facts.nearest_m,
                              file.within_m, limit);
  } else {
    result.text = "never reported its pose";
  }
  return result;
}

void not_evaluated(std::string_view reason, CheckResult& result) {
  result.holds = false;
  result.made = false;
  result.text = fmt::format("not evaluated: {}", reason);
}

/// Marks a goal that was not reached when the run was ended as not evaluated, if time was left.
void note_early(const std::optional<double>& before_s, double done_s, CheckResult& result) {
  if (result.holds || done_s > before_s.value_or(done_s + 1)) return;
  not_evaluated(fmt::format("the run was ended by hand at {:.2f} s; {}", done_s, result.text),
                result);
}

/// Marks a result as not evaluated if nothing is known of a robot that it needs.
void note_lost(const std::vector<RobotId>& robots, const sim::EngineSpec& spec,
               const std::vector<std::uint8_t>& lost, CheckResult& result) {
  for (const RobotId robot : robots) {
    if (robot.value() >= lost.size() || lost[robot.value()] == 0) continue;
    const std::string& name = spec.robots[robot.value()].name;
    return not_evaluated(fmt::format("nothing is known about `{}` here", name), result);
  }
}

/// Marks a result as not evaluated if a counting sensor never had a reading, or a robot never had a
/// known position.
void note_missing(const config::TouchesCheckFile& file, const std::vector<RobotId>& robots,
                  const std::vector<std::uint32_t>& silent, const sim::EngineSpec& spec,
                  const RunFacts& facts, CheckResult& result) {
  const auto not_made = [&](RobotId robot, std::string_view reason) {
    not_evaluated(
        fmt::format("{} of `{}` {}", file.sensor ? fmt::format("`{}`", **file.sensor) : "the place",
                    spec.robots[robot.value()].name, reason),
        result);
  };
  for (const RobotId robot : robots) {
    if (file.sensor) {
      if (std::ranges::find(silent, robot.value()) == silent.end()) continue;
      return not_made(robot, "never gave a reading");
    }
    const auto found = std::ranges::find(facts.robots, robot.value(), &RobotFacts::robot);
    if (found != facts.robots.end() && !found->known) return not_made(robot, "was never known");
  }
}

/// Marks a result as not evaluated if contacts are known only since a manager took over.
void note_unknown(const RunFacts& facts, CheckResult& result) {
  if (facts.world_from == 0) return;
  not_evaluated(fmt::format("contacts before step {} are known only to the previous manager",
                            facts.world_from),
                result);
}

}  // namespace

std::vector<CheckResult> goal_results(const config::ExpandedScenario& scenario,
                                      const sim::EngineSpec& spec, const RunFacts& facts,
                                      const std::vector<std::uint8_t>& lost, bool ended_early) {
  std::vector<CheckResult> results;
  const double done_s = static_cast<double>(facts.steps) * spec.step.seconds();
  const auto& checks = scenario.scenario.checks;
  for (std::size_t i = 0; i < checks.touches.size(); ++i) {
    const config::TouchesCheckFile& file = checks.touches[i];
    const std::vector<RobotId> robots = robots_of(scenario, file);
    std::uint64_t count = i < facts.goals.touches.size() ? facts.goals.touches[i] : 0;
    // With a sensor the robot's own bumper counts, without one the contacts that the world has
    // seen.
    if (!file.sensor) count = count_contacts(spec, facts.events, robots);
    results.push_back(touches_result(file, count));
    // A count that is too high already shows that the check fails, whatever is missing besides.
    const bool exceeds = static_cast<std::int64_t>(count) > file.most;
    if (ended_early && !exceeds) note_early({}, done_s, results.back());
    if (!exceeds) {
      static const std::vector<std::uint32_t> kNone;
      const auto& silent = i < facts.goals.silent.size() ? facts.goals.silent[i] : kNone;
      note_missing(file, robots, silent, spec, facts, results.back());
    }
    if (!file.sensor && !exceeds) note_unknown(facts, results.back());
    // Contacts are events of the world: where the manager has seen them all, results of a lost host
    // are not needed.
    if (file.sensor || !facts.has_world) note_lost(robots, spec, lost, results.back());
  }
  std::size_t next = 0;
  for (const config::ArrivalCheckFile& file : checks.arrivals) {
    for (const RobotId robot : named_robots(scenario, *file.robot)) {
      const bool there = next < facts.goals.arrivals.size();
      results.push_back(arrival_result(file, spec.robots[robot.value()].name,
                                       there ? facts.goals.arrivals[next] : ArrivalFacts()));
      if (ended_early) note_early(file.before_s, done_s, results.back());
      note_lost({robot}, spec, lost, results.back());
      ++next;
    }
  }
  return results;
}

}  // namespace rave::runtime
