// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/condition.hpp"

#include <gtest/gtest.h>

#include <set>

#include "rave/base/number.hpp"

namespace rave::experiment {
namespace {

config::ExperimentFile experiment_with(const std::string& factors, const std::string& more = "") {
  const auto read = config::read_experiment_text(
      "name: study\nscenario: room.yaml\nmetrics: [{name: hits, value: events.contact}]\n" + more +
          "factors:\n" + factors,
      "e.yaml");
  EXPECT_TRUE(read.has_value()) << read.error().text();
  return *read;
}

const std::string kTwoFactors =
    "  - {name: speed, key: a.speed, values: [1, 2.50]}\n"
    "  - {name: sensor, levels: [{name: none}, {name: far, set: {b.range: 5, a: {x: [1, "
    "far]}}}]}\n";

TEST(Conditions, CrossedHaveEachValueWithEachOther) {
  const auto experiment = experiment_with(kTwoFactors, "set: {changes: []}\n");
  const auto conditions = conditions_of(experiment);
  ASSERT_EQ(conditions.size(), 4U);
  EXPECT_EQ(condition_text(experiment, conditions[0]), "speed=1, sensor=none");
  EXPECT_EQ(conditions[0].settings, (std::vector<std::string>{"changes=[]", "a.speed=1"}));
  EXPECT_EQ(condition_text(experiment, conditions[3]), "speed=2.50, sensor=far");
  EXPECT_EQ(conditions[3].settings[2], "a={\"x\": [1, \"far\"]}");
  EXPECT_EQ(conditions[3].settings[3], "b.range=5");
  EXPECT_EQ(conditions[3].places[3].text(), "e.yaml:7:70");
}

TEST(Conditions, ZippedGoSideBySide) {
  const auto experiment = experiment_with(kTwoFactors, "design: zipped\n");
  const auto conditions = conditions_of(experiment);
  ASSERT_EQ(conditions.size(), 2U);
  EXPECT_EQ(condition_text(experiment, conditions[1]), "speed=2.50, sensor=far");
}

TEST(Conditions, ARangeHasBothEndsAndShortNumbers) {
  const auto conditions = conditions_of(
      experiment_with("  - {name: x, key: x, range: {low: 0, high: 0.3, steps: 4}}\n"));
  std::vector<std::string> levels;
  for (const Condition& condition : conditions) levels.push_back(condition.levels[0]);
  EXPECT_EQ(levels, (std::vector<std::string>{"0", "0.1", "0.2", "0.3"}));
}

TEST(Conditions, ALatinHypercubeHasOneValueOfEachPartOfEachFactor) {
  const std::string factors =
      "  - {name: x, key: x, range: {low: 0, high: 10}}\n"
      "  - {name: y, key: y, range: {low: -1, high: 1}}\n";
  const std::string design = "design: latin_hypercube\nsamples: 10\nfirst_seed: ";
  const auto conditions = conditions_of(experiment_with(factors, design + "1\n"));
  ASSERT_EQ(conditions.size(), 10U);
  std::set<int> parts_of_x;
  std::set<int> parts_of_y;
  for (const Condition& condition : conditions) {
    parts_of_x.insert(static_cast<int>(*number_of<double>(condition.levels[0])));
    parts_of_y.insert(static_cast<int>((*number_of<double>(condition.levels[1]) + 1) * 5));
  }
  EXPECT_EQ(parts_of_x.size(), 10U);
  EXPECT_EQ(parts_of_y.size(), 10U);
  const auto other = conditions_of(experiment_with(factors, design + "2\n"));
  EXPECT_NE(other[0].levels, conditions[0].levels);
}

}  // namespace
}  // namespace rave::experiment
