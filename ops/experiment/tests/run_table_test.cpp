// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/run_table.hpp"

#include <gtest/gtest.h>

namespace rave::experiment {
namespace {

TEST(RunTable, HasTheFinishedRunsInTheOrderOfThePlan) {
  Plan plan;
  plan.experiment = *config::read_experiment_text(
      "name: study\nscenario: room.yaml\nrepetitions: 2\n"
      "factors: [{name: x, key: a.x, values: [1, \"two, or\"]}]\n"
      "metrics: [{name: caught, value: t, time_to_event: true}, {name: hits, value: n}]\n",
      "e.yaml");
  for (Condition& condition : conditions_of(plan.experiment)) {
    plan.conditions.push_back({condition, "inputs-" + condition.levels[0], 60});
  }
  RunRows rows;
  rows.add(RunRow{"inputs-two, or", 2, "", {std::nullopt, 3}, 60, "00", 1});
  rows.add(RunRow{"inputs-1", 1, "", {12.25, std::nullopt}, 12.25, "ab", 2});
  rows.add(RunRow{"inputs-1", 2, "ended by signal 9 (Killed)", {}, 0, "", 2});
  rows.add(RunRow{"inputs-of-before", 1, "", {1, 1}, 12.25, "ab", 2});
  EXPECT_EQ(run_table(plan, rows),
            "condition,x,seed,failure,caught,caught_seen,hits,simulated_s,hash,command\n"
            "1,1,1,,12.25,1,,12.25,ab,rave run room.yaml --set a.x=1 --seed 1\n"
            "1,1,2,ended by signal 9 (Killed),,,,0,,rave run room.yaml --set a.x=1 --seed 2\n"
            "2,\"two, or\",2,,60,0,3,60,00,\"rave run room.yaml --set 'a.x=\"\"two, or\"\"' --seed "
            "2\"\n");
}

}  // namespace
}  // namespace rave::experiment
