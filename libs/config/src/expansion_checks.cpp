// SPDX-License-Identifier: Apache-2.0
// What can be checked only when all files are read: names that refer to each other, and times that
// must fit the step.
#include "expansion_checks.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "file_checks.hpp"
#include "people_fields.hpp"
#include "rave/base/names.hpp"
#include "rave/base/time.hpp"

namespace rave::config {
namespace {

class Checks {
 public:
  Checks(const ExpandedScenario& expanded, Diagnostics& diagnostics)
      : expanded_(expanded), scenario_(expanded.scenario), diagnostics_(diagnostics) {}

  void run() {
    unique_obstacles();
    unique_robots();
    unique_barcodes();
    for (const RobotGroup& group : expanded_.groups) {
      timing(group.robot);
      if (group.twin) timing(group.twin->robot);
    }
    sightings();
    for (const TouchesCheckFile& check : scenario_.checks.touches) touches(check);
    for (const ArrivalCheckFile& check : scenario_.checks.arrivals) (void)groups_of(check.robot);
    odometry();
    for (const ChangeFile& change : scenario_.changes) {
      if (change.robot) robots_exist("robot", *change.robot);
      if (change.robot && change.hand_over) twins_exist(*change.robot);
      if (change.at_s) multiple_of_step("at_s", *change.at_s);
      if (change.every_s) multiple_of_step("every_s", *change.every_s);
      multiple_of_step("delay_s", change.delay_s);
      if (change.after) entry_exists(*change.after);
      if (change.after) not_after_itself(change);
      conducted_in_lock_step(change);
    }
    if (auto hosts = plan_hosts(expanded_); !hosts) diagnostics_.add(std::move(hosts).error());
    if (scenario_.checks.capture) {
      robots_exist("predator", scenario_.checks.capture->predator);
      robots_exist("prey", scenario_.checks.capture->prey);
    }
  }

 private:
  template <class... Args>
  void report(const SourceLocation& where, fmt::format_string<Args...> format, Args&&... args) {
    diagnostics_.add(where, fmt::format(format, std::forward<Args>(args)...));
  }

  void unique_obstacles() {
    const RawNode nowhere;
    CheckContext check(nowhere, diagnostics_);
    check_unique("obstacle", expanded_.world.obstacles, check);
  }

  void unique_robots() {
    std::unordered_map<std::string_view, std::size_t> seen;
    for (const ExpandedRobot& robot : expanded_.robots) {
      // An entry `a-1` clashes with the first of several robots of an entry `a`.
      const auto [first, is_new] = seen.emplace(robot.name, robot.group);
      if (is_new) continue;
      report(expanded_.group_of(robot).name.where, "{}",
             named_twice("robot", robot.name, expanded_.groups[first->second].name.where));
    }
  }

  /// Two bodies with one barcode could not be distinguished by a camera.
  void unique_barcodes() {
    struct Bearer {
      std::string what;
      const SourceLocation* where;
      bool told = false;
    };
    std::unordered_map<int, Bearer> bearers;
    const auto carries = [&](int code, std::string what, const SourceLocation& where) {
      const auto [first, is_new] = bearers.try_emplace(code, Bearer{what, &where});
      if (is_new || std::exchange(first->second.told, true)) return;
      report(where, "{} carries the barcode {}, and so does {} ({}); expected a code of its own",
             what, code, first->second.what, first->second.where->text());
    };
    for (const ObstacleFile& obstacle : expanded_.world.obstacles) {
      if (!obstacle.barcode) continue;
      carries(*obstacle.barcode, fmt::format("obstacle `{}`", *obstacle.name), obstacle.name.where);
    }
    for (const ExpandedRobot& robot : expanded_.robots) {
      const RobotGroup& group = expanded_.group_of(robot);
      const auto& barcode = group.robot.body.value.barcode;
      if (barcode) carries(*barcode, fmt::format("robot `{}`", robot.name), group.name.where);
    }
  }

  void twins_exist(const Located<std::string>& name) {
    for (const std::size_t r : robots_named(expanded_, *name)) {
      const ExpandedRobot& robot = expanded_.robots[r];
      if (expanded_.group_of(robot).twin) continue;
      report(name.where, "`hand_over`: robot `{}` has no `twin` with other drivers", robot.name);
    }
  }

  void timing(const RobotFile& robot) {
    for (const SensorFile& sensor : robot.sensors) timing(sensor.period_s, sensor.phase_s);
    if (robot.program) timing(robot.program->period_s, robot.program->phase_s);
    if (robot.report_period_s) multiple_of_step("report_period_s", *robot.report_period_s);
  }

  void timing(const std::optional<Located<double>>& period_s, const Located<double>& phase_s) {
    if (period_s) multiple_of_step("period_s", *period_s);
    multiple_of_step("phase_s", phase_s);
    if (!period_s && *phase_s >= *scenario_.step_s) {
      report(phase_s.where,
             "`phase_s`: found {}, expected less than the period, which is the step ({} s)",
             *phase_s, *scenario_.step_s);
    }
  }

  void multiple_of_step(std::string_view key, const Located<double>& time_s) {
    // In whole nanoseconds: with binary fractions, 0.3 s would be no multiple of 0.1 s.
    const std::int64_t step_ns = from_seconds(*scenario_.step_s).ns;
    const std::int64_t ns = from_seconds(*time_s).ns;
    // A period below half a nanosecond rounds to 0.
    if (ns % step_ns == 0 && (ns > 0 || *time_s == 0)) return;
    report(time_s.where, "`{}`: found {}, expected a multiple of the scenario's step ({} s)", key,
           *time_s, *scenario_.step_s);
  }

  void entry_exists(const Located<std::string>& name) {
    std::vector<std::string_view> names;
    for (const ChangeFile& change : scenario_.changes) names.emplace_back(change.name);
    if (std::ranges::count(names, *name) == 1) return;
    report(name.where, "`after`: expected the `name` of one entry of `changes`, found {} `{}`{}",
           std::ranges::count(names, *name) == 0 ? "none that is" : "several that are", *name,
           suggestion(*name, names));
  }

  void not_after_itself(const ChangeFile& change) {
    const ChangeFile* before = &change;
    for (std::size_t steps = 0; before->after && steps <= scenario_.changes.size(); ++steps) {
      const auto next = std::ranges::find(scenario_.changes, **before->after, &ChangeFile::name);
      if (next == scenario_.changes.end()) return;
      before = &*next;
    }
    if (!before->after) return;
    report(change.after->where, "`after`: `{}` waits for itself, so it never happens",
           **change.after);
  }

  /// The hosts of a run in real time have no common step at which something could be decided.
  void conducted_in_lock_step(const ChangeFile& change) {
    const bool many = scenario_.processes || !scenario_.hosts.empty();
    if (change.is_scheduled() || scenario_.clock == RunClockMode::kLockStep || !many) return;
    const Located<std::string>* const at = change.when ? &*change.when : nullptr;
    report(at != nullptr ? at->where : scenario_.name.where,
           "conditions need one process or `clock: lock_step`; here hosts run in real time");
  }

  /// Checks that a name is a robot or an entry.
  void robots_exist(std::string_view key, const Located<std::string>& name) {
    if (!robots_named(expanded_, *name).empty()) return;
    report(name.where, "`{}`: there is no robot `{}`{}", key, *name,
           robot_suggestion(expanded_, *name));
  }

  static bool has_sensor(const RobotGroup& group, const std::string& name) {
    const auto& sensors = group.robot.sensors;
    return std::any_of(sensors.begin(), sensors.end(),
                       [&name](const SensorFile& s) { return *s.name == name; });
  }

  /// Whether any robot has the sensor; reports an error if not.
  bool sensor_exists(std::string_view key, const Located<std::string>& name) {
    std::set<std::string_view> all;
    for (const RobotGroup& group : expanded_.groups) {
      for (const SensorFile& sensor : group.robot.sensors) all.insert(*sensor.name);
    }
    if (all.contains(*name)) return true;
    const std::vector<std::string_view> names(all.begin(), all.end());
    report(name.where, "`{}`: no robot has a sensor `{}`{}", key, *name, suggestion(*name, names));
    return false;
  }

  void sightings() {
    if (!scenario_.checks.sightings) return;
    const SightingsCheckFile& check = *scenario_.checks.sightings;
    const bool has_real = sensor_exists("real", check.real);
    const bool has_twin = sensor_exists("twin", check.twin);
    if (!has_real || !has_twin) return;
    const auto& groups = expanded_.groups;
    const bool together = std::any_of(groups.begin(), groups.end(), [&](const RobotGroup& group) {
      return has_sensor(group, *check.real) && has_sensor(group, *check.twin);
    });
    if (together) return;
    report(check.twin.where, "no robot has both the sensors `{}` and `{}`", *check.real,
           *check.twin);
  }

  /// The groups of a robot or entry; reports an error if there are none.
  std::set<std::size_t> groups_of(const Located<std::string>& name) {
    std::set<std::size_t> found;
    for (const std::size_t r : robots_named(expanded_, *name)) {
      found.insert(expanded_.robots[r].group);
    }
    if (found.empty()) {
      report(name.where, "there is no robot `{}`{}", *name, robot_suggestion(expanded_, *name));
    }
    return found;
  }

  void touches(const TouchesCheckFile& check) {
    for (const Located<std::string>& name : check.robots) {
      const std::set<std::size_t> groups = groups_of(name);
      if (!check.sensor || !sensor_exists("sensor", *check.sensor)) continue;
      for (const std::size_t group : groups) {
        if (has_sensor(expanded_.groups[group], **check.sensor)) continue;
        report(check.sensor->where, "robot `{}` has no sensor `{}`", *name, **check.sensor);
      }
    }
  }

  void odometry() {
    if (!scenario_.picture || !scenario_.picture->odometry_sensor) return;
    (void)sensor_exists("odometry_sensor", *scenario_.picture->odometry_sensor);
  }

  const ExpandedScenario& expanded_;
  const ScenarioFile& scenario_;
  Diagnostics& diagnostics_;
};

}  // namespace

void check_expansion(const ExpandedScenario& expanded, Diagnostics& diagnostics) {
  Checks(expanded, diagnostics).run();
  check_people(expanded, diagnostics);
}

}  // namespace rave::config
