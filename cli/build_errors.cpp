// SPDX-License-Identifier: Apache-2.0
#include "build_errors.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace rave::cli {
namespace {

using config::ExpandedScenario;
using config::RobotFile;
using config::RobotGroup;

/// Each error costs a build of the scenario.
constexpr int kMostErrors = 200;

bool same(const SourceLocation& a, const SourceLocation& b) {
  return std::tie(a.file, a.line, a.column) == std::tie(b.file, b.line, b.column);
}

/// Whether `where` lies in the entry of a list that has its name at `name` and its driver at
/// `driver`. Entries are as long as up to the next one, so the last that begins before wins.
bool begins_before(const SourceLocation& begin, const SourceLocation& where) {
  return begin.file == where.file &&
         std::tie(begin.line, begin.column) <= std::tie(where.line, where.column);
}

/// runtime::build() stops at its first error. So the part with the error is taken out and the rest
/// is built again, until it builds or nothing can be taken out.
class Search {
 public:
  explicit Search(ExpandedScenario scenario) : scenario_(std::move(scenario)) {}

  std::vector<Error> run(plugin::Catalogue& catalogue, const runtime::BuildOptions& options) {
    for (int i = 0; i < kMostErrors && !scenario_.robots.empty(); ++i) {
      auto built = runtime::build(scenario_, catalogue, options);
      if (built) break;
      const Error& error = built.error();
      const bool known = !texts_.insert(error.text()).second;
      if (take_device(error.where)) {
        if (!known) errors_.push_back(error);
      } else {
        // A group that lost a device fails for that reason alone, which was told already.
        const bool follows = is_tainted(error.where);
        if (!known && !follows) errors_.push_back(error);
        if (!take_group(error.where) && !take_map(error.where)) break;
      }
    }
    return std::move(errors_);
  }

 private:
  /// Takes out the device that a place lies in, of every group that came from the same file.
  bool take_device(const SourceLocation& where) {
    if (where.file.empty()) return false;
    for (RobotGroup& group : scenario_.groups) {
      RobotFile& robot = group.robot;
      if (is_at_whole(group, where)) continue;
      if (take_from(robot, where)) {
        tainted_.insert(group.name.where.text());
        return true;
      }
    }
    return false;
  }

  static bool is_at_whole(const RobotGroup& group, const SourceLocation& where) {
    return same(group.name.where, where) || same(group.robot.body.where, where) ||
           (group.robot.pose_from && same(group.robot.pose_from->where, where));
  }

  /// Devices in the order of the file: the one whose beginning is the last before the place.
  static bool take_from(RobotFile& robot, const SourceLocation& where) {
    SourceLocation best;
    std::function<void()> take;
    const auto consider = [&](const SourceLocation& name, const SourceLocation& driver,
                              std::function<void()> erase) {
      const SourceLocation& begin = begins_before(name, driver) ? name : driver;
      if (!begins_before(begin, where) || (take && !begins_before(best, begin))) return;
      best = begin;
      take = std::move(erase);
    };
    const auto consider_all = [&](const auto& list, auto erase) {
      for (const auto& item : list) {
        consider(item.name.where, item.driver.where,
                 [&robot, erase, name = item.name.value] { erase(robot, name); });
      }
    };
    consider_all(robot.sensors, erase_sensor);
    consider_all(robot.actuators, erase_actuator);
    consider_all(robot.controllers, [](RobotFile& its, const std::string& name) {
      std::erase_if(its.controllers, [&](const auto& c) { return c.name.value == name; });
    });
    consider_all(robot.devices, erase_device);
    if (robot.program) {
      const SourceLocation& place = robot.program->driver.where;
      consider(place, place, [&robot] { robot.program.reset(); });
    }
    if (take) take();
    return !best.file.empty();
  }

  static void erase_sensor(RobotFile& robot, const std::string& name) {
    // Else it would name a sensor that is no longer there, an error of this search.
    if (robot.pose_from && robot.pose_from->value == name) robot.pose_from.reset();
    std::erase_if(robot.sensors, [&](const auto& sensor) { return sensor.name.value == name; });
  }

  static void erase_actuator(RobotFile& robot, const std::string& name) {
    std::erase_if(robot.controllers, [&](const auto& c) { return c.actuator.value == name; });
    std::erase_if(robot.actuators, [&](const auto& a) { return a.name.value == name; });
  }

  /// With a device goes what is part of it.
  static void erase_device(RobotFile& robot, const std::string& name) {
    const auto uses = [&](const auto& item) { return item.device && item.device->value == name; };
    for (const config::SensorFile& sensor : std::vector(robot.sensors)) {
      if (uses(sensor) || (sensor.real && uses(*sensor.real)))
        erase_sensor(robot, sensor.name.value);
    }
    for (const config::ActuatorFile& actuator : std::vector(robot.actuators)) {
      if (uses(actuator)) erase_actuator(robot, actuator.name.value);
    }
    std::erase_if(robot.devices, [&](const auto& device) { return device.name.value == name; });
  }

  [[nodiscard]] bool is_tainted(const SourceLocation& where) const {
    return std::any_of(scenario_.groups.begin(), scenario_.groups.end(), [&](const auto& group) {
      return is_at_whole(group, where) && tainted_.contains(group.name.where.text());
    });
  }

  bool take_group(const SourceLocation& where) {
    for (std::size_t g = 0; g < scenario_.groups.size(); ++g) {
      if (!is_at_whole(scenario_.groups[g], where)) continue;
      std::erase_if(scenario_.robots, [&](const auto& robot) { return robot.group == g; });
      for (config::ExpandedRobot& robot : scenario_.robots) {
        if (robot.group > g) --robot.group;
      }
      scenario_.groups.erase(scenario_.groups.begin() + static_cast<std::ptrdiff_t>(g));
      return true;
    }
    return false;
  }

  bool take_map(const SourceLocation& where) {
    const auto is_it = [&](const config::MapFile& map) { return same(map.file.where, where); };
    return std::erase_if(scenario_.world.maps, is_it) > 0;
  }

  ExpandedScenario scenario_;
  std::vector<Error> errors_;
  std::set<std::string> texts_;    ///< Of errors seen, as several groups may use one file.
  std::set<std::string> tainted_;  ///< Places of groups that lost a device.
};

}  // namespace

std::vector<Error> build_errors(ExpandedScenario scenario, plugin::Catalogue& catalogue,
                                const runtime::BuildOptions& options) {
  return Search(std::move(scenario)).run(catalogue, options);
}

}  // namespace rave::cli
