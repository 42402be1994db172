// SPDX-License-Identifier: Apache-2.0
#include "goal_checks.hpp"

#include <algorithm>
#include <cmath>

namespace rave::robot_host {
namespace {

/// The robots that a name of a robot or of an entry stands for.
std::vector<RobotId> robots_named(const config::ExpandedScenario& scenario,
                                  const std::string& name) {
  std::vector<RobotId> found;
  for (std::uint32_t r = 0; r < scenario.robots.size(); ++r) {
    const config::ExpandedRobot& robot = scenario.robots[r];
    if (robot.name == name || *scenario.group_of(robot).name == name) found.emplace_back(r);
  }
  return found;
}

std::string listed(const std::vector<config::Located<std::string>>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + *name;
  return text;
}

bool contains(const std::vector<RobotId>& robots, RobotId robot) {
  return std::find(robots.begin(), robots.end(), robot) != robots.end();
}

}  // namespace

GoalChecks::GoalChecks(const config::ExpandedScenario& scenario, const sim::EngineSpec& spec) {
  for (const config::TouchesCheckFile& file : scenario.scenario.checks.touches) {
    Touches touches{file, {}, {}, 0};
    for (const auto& name : file.robots) {
      for (const RobotId robot : robots_named(scenario, *name)) {
        if (!contains(touches.robots, robot)) touches.robots.push_back(robot);
      }
    }
    for (const RobotId robot : touches.robots) {
      const auto& sensors = spec.types[spec.robots[robot.value()].type].sensors;
      for (std::uint32_t s = 0; file.sensor && s < sensors.size(); ++s) {
        if (sensors[s].name == **file.sensor) touches.feelers.push_back({robot, s, false});
      }
    }
    touches_.push_back(std::move(touches));
  }
  for (const config::ArrivalCheckFile& file : scenario.scenario.checks.arrivals) {
    for (const RobotId robot : robots_named(scenario, *file.robot)) {
      arrivals_.push_back({file, spec.robots[robot.value()].name, robot, std::nullopt, 0, false});
    }
  }
}

void GoalChecks::count_events(const sim::Engine& engine, Touches& touches) {
  for (const sim::Event& event : engine.events()) {
    if (event.kind != sim::EventKind::kContact) continue;
    // The one that pushes has the event; the one that is pushed has been touched as well.
    const bool concerned =
        contains(touches.robots, event.robot) ||
        std::any_of(touches.robots.begin(), touches.robots.end(),
                    [&](RobotId robot) { return engine.snapshot().body_of(robot) == event.other; });
    if (concerned) ++touches.count;
  }
}

void GoalChecks::count_readings(const sim::Engine& engine, Touches& touches) {
  for (Feeler& feeler : touches.feelers) {
    const sim::SensorSample sample = engine.sensor(feeler.robot, feeler.sensor);
    if (sample.info->kind != ReadingKind::kContact || sample.header->count == 0) continue;
    const auto* first = static_cast<const ContactReading*>(sample.records);
    const bool touching = std::any_of(first, first + sample.header->count,
                                      [](const ContactReading& c) { return c.touching != 0; });
    if (touching && !feeler.touching) ++touches.count;
    feeler.touching = touching;
  }
}

void GoalChecks::after_step(sim::Engine& engine) {
  for (Touches& touches : touches_) {
    if (touches.file.sensor) {
      count_readings(engine, touches);
    } else {
      count_events(engine, touches);
    }
  }
  for (Arrival& arrival : arrivals_) {
    const sim::ReportedPose& pose = engine.reported(arrival.id);
    if (!pose.known || arrival.time_s) continue;
    const double off_m =
        std::hypot(pose.pose.x_m - arrival.file.x_m, pose.pose.y_m - arrival.file.y_m);
    arrival.nearest_m = arrival.known ? std::min(arrival.nearest_m, off_m) : off_m;
    arrival.known = true;
    const double now_s = engine.time().seconds();
    if (off_m <= arrival.file.within_m && now_s <= arrival.file.before_s.value_or(now_s)) {
      arrival.time_s = now_s;
    }
  }
}

std::vector<CheckResult> GoalChecks::results() const {
  std::vector<CheckResult> results;
  for (const Touches& touches : touches_) {
    const auto& [robots, sensor, most, least] = touches.file;
    CheckResult result;
    result.name = fmt::format("touches of {}{}", listed(robots),
                              sensor ? fmt::format(" (by `{}`)", **sensor) : std::string());
    result.holds = touches.count >= least && touches.count <= most;
    result.text = least > 0 ? fmt::format("{}, expected {} to {}", touches.count, least, most)
                            : fmt::format("{}, expected at most {}", touches.count, most);
    results.push_back(std::move(result));
  }
  for (const Arrival& arrival : arrivals_) {
    CheckResult result;
    result.name = fmt::format("{} comes to ({:.2f}, {:.2f}) m", arrival.robot, arrival.file.x_m,
                              arrival.file.y_m);
    result.holds = arrival.time_s.has_value();
    const std::string limit =
        arrival.file.before_s ? fmt::format(" before {} s", *arrival.file.before_s) : std::string();
    if (arrival.time_s) {
      result.text = fmt::format("at {:.2f} s", *arrival.time_s);
    } else if (arrival.known) {
      result.text = fmt::format("came no nearer than {:.2f} m, expected {} m{}", arrival.nearest_m,
                                arrival.file.within_m, limit);
    } else {
      result.text = "never said where it is";
    }
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace rave::robot_host
