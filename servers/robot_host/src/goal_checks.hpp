// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "observer.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::robot_host {

/// How one check of a scenario went, for people and for result.json.
struct CheckResult {
  std::string name;  ///< `touches of rover`
  std::string text;  ///< `2, expected at most 0`
  bool holds = false;
};

/// What a scenario wants its robots to do: come to places, and not touch things.
class GoalChecks final : public Observer {
 public:
  GoalChecks(const config::ExpandedScenario& scenario, const sim::EngineSpec& spec);

  void after_step(sim::Engine& engine) override;

  /// One for each entry of `checks: touches:` and `checks: arrivals:`, in that order.
  [[nodiscard]] std::vector<CheckResult> results() const;

 private:
  /// A contact sensor of one robot, and whether it said that it touches.
  struct Feeler {
    RobotId robot;
    std::uint32_t sensor = 0;
    bool touching = false;
  };
  struct Touches {
    config::TouchesCheckFile file;
    std::vector<RobotId> robots;
    std::vector<Feeler> feelers;  ///< Empty: events count.
    int count = 0;
  };
  struct Arrival {
    config::ArrivalCheckFile file;
    std::string robot;
    RobotId id;
    std::optional<double> time_s;
    double nearest_m = 0;
    bool known = false;
  };
  static void count_events(const sim::Engine& engine, Touches& touches);
  static void count_readings(const sim::Engine& engine, Touches& touches);

  std::vector<Touches> touches_;
  std::vector<Arrival> arrivals_;
};

}  // namespace rave::robot_host
