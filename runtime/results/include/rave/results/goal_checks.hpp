// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rave/config/expanded_scenario.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/results/facts.hpp"

namespace rave::runtime {

/// How one check of a scenario went, for people and for result.json.
struct CheckResult {
  std::string name;  ///< `touches of rover`
  std::string text;  ///< `2, expected at most 0`
  bool holds = false;
  bool made = true;  ///< False: nobody knows, since a part of the run left nothing here.
};

/// What a scenario wants its robots to do: come to places, and not touch things.
class GoalChecks final : public RunObserver {
 public:
  GoalChecks(const config::ExpandedScenario& scenario, const sim::EngineSpec& spec);

  void after_step(const StepView& step) override;

  /// Of robots that run here.
  [[nodiscard]] GoalFacts facts() const;

 private:
  /// A contact sensor of one robot, and whether it said that it touches.
  struct Feeler {
    RobotId robot;
    std::uint32_t sensor = 0;
    bool touching = false;
    bool here = false;   ///< It runs in this process.
    bool heard = false;  ///< It has given a reading.
  };
  struct Touches {
    std::vector<Feeler> feelers;  ///< Empty: events count.
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

/// One for each entry of `checks: touches:` and, by robot, of `checks: arrivals:`, in that order.
/// `lost`: by robot, 1 where nothing is known of it; empty: all is known.
[[nodiscard]] std::vector<CheckResult> goal_results(const config::ExpandedScenario& scenario,
                                                    const sim::EngineSpec& spec,
                                                    const RunFacts& facts,
                                                    const std::vector<std::uint8_t>& lost);

}  // namespace rave::runtime
