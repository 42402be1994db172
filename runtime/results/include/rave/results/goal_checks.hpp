// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rave/config/expanded_scenario.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/results/facts.hpp"

namespace rave::runtime {

/// The result of one check of a scenario, for people and for result.json.
struct CheckResult {
  std::string name;  ///< `touches of rover`
  std::string text;  ///< `2, expected at most 0`
  bool holds = false;
  /// False: it could not be evaluated, because facts of some robots are missing.
  bool made = true;
};

/// The ids of config::robots_named().
[[nodiscard]] std::vector<RobotId> named_robots(const config::ExpandedScenario& scenario,
                                                std::string_view name);

/// The checks of touches and arrivals of a scenario.
class GoalChecks final : public RunObserver {
 public:
  GoalChecks(const config::ExpandedScenario& scenario, const sim::EngineSpec& spec);

  void after_step(const StepView& step) override;

  /// The facts of the robots that run here.
  [[nodiscard]] GoalFacts facts() const;

 private:
  /// The contact sensor of one robot and its last state.
  struct Feeler {
    RobotId robot;
    std::uint32_t sensor = 0;
    bool touching = false;
    bool here = false;   ///< The robot runs in this process.
    bool heard = false;  ///< It has given a reading.
  };
  struct Touches {
    std::vector<Feeler> feelers;  ///< Empty: contact events are counted.
    std::uint64_t count = 0;
  };
  struct Arrival {
    config::ArrivalCheckFile file;
    RobotId id;
    ArrivalFacts facts;
  };
  static void count_readings(const sim::Engine& engine, Touches& touches);

  std::vector<Touches> touches_;
  std::vector<Arrival> arrivals_;
};

/// The results for each entry of `checks: touches:`, then for each robot of each entry of `checks:
/// arrivals:`. `lost`: by robot, 1 if its facts are missing; empty: none is missing. `ended_early`:
/// a goal that was not reached, but could have been later, is not evaluated.
[[nodiscard]] std::vector<CheckResult> goal_results(const config::ExpandedScenario& scenario,
                                                    const sim::EngineSpec& spec,
                                                    const RunFacts& facts,
                                                    const std::vector<std::uint8_t>& lost,
                                                    bool ended_early = false);

}  // namespace rave::runtime
