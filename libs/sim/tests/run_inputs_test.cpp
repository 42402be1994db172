// SPDX-License-Identifier: Apache-2.0
#include "input_parts.hpp"
#include "rave/sim_testing/given.hpp"
#include "rave/sim_testing/order_programs.hpp"

namespace rave::sim::testing {
namespace {

constexpr ParamSpec kGearParams[] = {integer_param("gear", 1, 1, 5, "Only odd ones are built.")};

/// Says which gears it was given; refuses even ones.
class Gears final : public DecisionProcess {
 public:
  inline static std::vector<std::int64_t> seen;
  Status start(const Setup& /*setup*/) override { return {}; }
  Status parameters_changed(const Params& params) override {
    const std::int64_t gear = static_cast<std::int64_t>(given(params, "gear"));
    if (gear % 2 == 0) return fail(ErrorCode::kInvalidArgument, "no such gear");
    seen.push_back(gear);
    return {};
  }
  void decide(const Percepts& /*percepts*/, Commands& /*commands*/) override {}
};

RobotType geared_type() {
  RobotType type = simulated_type();
  type.program = program<Gears>({{"gear", 1}});
  type.program->param_specs = kGearParams;
  Gears::seen.clear();
  return type;
}

EngineSpec one(RobotType type) {
  EngineSpec spec;
  add_robot(spec, std::move(type));
  return spec;
}

ParameterChange gear(std::int64_t value) {
  return {ParameterChange::Part::kProgram, 0, "gear", static_cast<double>(value)};
}
ParameterChange scale(double value) { return {ParameterChange::Part::kBody, 0, "scale", value}; }

TEST(RunInputs, AChangeReachesTheProgramAndIsWrittenDown) {
  InputParts parts(one(geared_type()));
  const std::vector changes{gear(3)};
  ASSERT_TRUE(parts.inputs.change(7, kRobot, changes, Author::kHand));
  EXPECT_EQ(Gears::seen, (std::vector<std::int64_t>{3}));
  const auto told = parts.told();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].step, 7U);
  EXPECT_EQ(told[0].text, "program.gear: 1 -> 3 (by hand)");
  const std::vector next{gear(5)};
  ASSERT_TRUE(parts.inputs.change(8, kRobot, next, Author::kRun));
  EXPECT_EQ(parts.told()[0].text, "program.gear: 3 -> 5");
  EXPECT_EQ(parts.log.by_hand(), 1U);
}

TEST(RunInputs, WhatWasMadeBeforeARefusalIsUndone) {
  InputParts parts(one(geared_type()));
  const std::uint64_t before = parts.hash.value();
  const std::vector changes{gear(3), scale(-1)};
  const Status status = parts.inputs.change(0, kRobot, changes, Author::kHand);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().text().find("robot `r0`, body"), std::string::npos)
      << status.error().text();
  EXPECT_EQ(Gears::seen, (std::vector<std::int64_t>{3, 1})) << "and was given back";
  EXPECT_TRUE(parts.told().empty());
  EXPECT_EQ(parts.log.by_hand(), 0U);
  EXPECT_EQ(parts.hash.value(), before);
}

TEST(RunInputs, ABodyIsChangedAndWhoKeepsPicturesOfItIsTold) {
  InputParts parts(one(geared_type()));
  const std::vector changes{scale(2)};
  ASSERT_TRUE(parts.inputs.change(0, kRobot, changes, Author::kHand));
  EXPECT_EQ(parts.truth.scale_of(kRobot), 2);
  EXPECT_EQ(parts.calls, (std::vector<std::string>{"body"}));
  EXPECT_EQ(Gears::seen, (std::vector<std::int64_t>{1})) << "a program may keep the radius";
}

TEST(RunInputs, AStopIsToldOnceAndEndsOrders) {
  InputParts parts(one(driver_type()));
  ASSERT_TRUE(parts.orders.take(0, drive(kRobot, 0.5, 0), {}, false));
  parts.inputs.stop(1, RobotId(), {true, "bert"});
  parts.inputs.stop(2, kRobot, Author::kHand);
  EXPECT_TRUE(parts.guards[0].holds().stopped);
  EXPECT_EQ(parts.orders.under_way(kRobot), "");
  auto told = parts.told();
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[1].kind, EventKind::kStopped);
  EXPECT_EQ(told[1].text, "by hand: bert");
  parts.inputs.release(3, kRobot, Author::kHand);
  parts.inputs.release(3, kRobot, Author::kHand);
  parts.inputs.arm(3, kRobot, Author::kHand);
  told = parts.told();
  ASSERT_EQ(told.size(), 1U) << "a simulated robot need not be armed";
  EXPECT_EQ(told[0].kind, EventKind::kReleased);
}

TEST(RunInputs, WhatTheScenarioHasIsMadeInItsStepInEachRun) {
  EngineSpec spec = one(geared_type());
  spec.changes = {{2, kRobot, {gear(3)}}, {3, kRobot, {gear(2)}}};
  InputParts parts(std::move(spec));
  for (int run = 0; run < 2; ++run) {
    parts.inputs.make_scheduled(1);
    EXPECT_TRUE(parts.told().empty());
    parts.inputs.make_scheduled(2);
    parts.inputs.make_scheduled(3);
    const auto told = parts.told();
    ASSERT_EQ(told.size(), 2U);
    EXPECT_EQ(told[0].kind, EventKind::kChanged);
    EXPECT_EQ(told[1].kind, EventKind::kChangeRefused);
    EXPECT_NE(told[1].text.find("no such gear"), std::string::npos);
    parts.inputs.begin();
  }
  EXPECT_EQ(parts.log.by_hand(), 0U);
}

TEST(RunInputs, OneOfSeveralHostsLeavesBodiesToTheAuthority) {
  EngineSpec spec = one(geared_type());
  spec.changes = {{0, kRobot, {scale(2)}}, {0, kRobot, {gear(3)}}};
  InputParts parts(std::move(spec));
  parts.inputs.make_scheduled_here(0);
  EXPECT_EQ(parts.truth.scale_of(kRobot), 1);
  EXPECT_EQ(parts.told().size(), 1U);
  ASSERT_TRUE(parts.inputs.resize({.robot = kRobot, .scale = 2}));
  EXPECT_EQ(parts.truth.scale_of(kRobot), 2);
  EXPECT_TRUE(parts.told().empty()) << "the authority tells of it";
}

TEST(RunInputs, AnObstacleIsChangedOrNothingIs) {
  InputParts parts(one(geared_type()));
  ObstacleChange add;
  add.name = "crate";
  add.X_WB = {3, 0, 0};
  add.body = box({}, 1, 1).body;
  const auto made = parts.inputs.change_obstacle(4, add, Author::kHand);
  ASSERT_TRUE(made) << made.error().text();
  EXPECT_EQ(made->step, 4U);
  EXPECT_EQ(parts.calls, (std::vector<std::string>{"obstacle"}));
  EXPECT_FALSE(parts.inputs.change_obstacle(5, add, Author::kHand)) << "the name is taken";
  EXPECT_EQ(parts.calls.size(), 1U);
  const auto told = parts.told();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].kind, EventKind::kObstacleAdded);
  EXPECT_EQ(told[0].text, made->text);
}

}  // namespace
}  // namespace rave::sim::testing
