// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <functional>
#include <limits>

#include "split_drivers.hpp"
#include "split_run.hpp"

namespace rave::sim::testing {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

RobotType talking_driver() {
  RobotType type = simulated_type();
  add_transmitter(type);
  add_communicator(type);
  type.program = program<Gossip>({{"v", 0.3}, {"throw_at", 0}});
  return type;
}

/// Two simulated robots that talk, on host 0, and two real ones, on host 1.
EngineSpec four() {
  EngineSpec spec;
  add_robot(spec, talking_driver());
  add_twin(spec, {1, 0, 0});
  add_robot(spec, real_type({{"x", 3}}));
  add_twin(spec, {});
  return spec;
}
const std::vector<std::uint32_t> kFourOn{0, 0, 1, 1};

/// The error with which the authority answers if the reports are changed like this after 10 steps.
/// Expects that nothing has changed: the run goes on as if it had not happened.
std::string refusal(const std::function<void(std::vector<HostReport>&)>& spoil) {
  SplitRun run(four, kFourOn);
  SplitRun other(four, kFourOn);
  for (int k = 0; k < 10; ++k) {
    EXPECT_TRUE(run.advance());
    EXPECT_TRUE(other.advance());
  }
  EXPECT_TRUE(run.apply());
  for (std::size_t h = 0; h < run.hosts.size(); ++h) {
    EXPECT_TRUE(run.hosts[h]->propose(run.reports[h]));
  }
  std::vector<HostReport> spoilt = run.reports;
  spoil(spoilt);
  std::vector<const HostReport*> all;
  for (const HostReport& report : spoilt) all.push_back(&report);
  const WorldStep before = run.world;
  const RunHash hash = run.authority->hash();
  const Status status = run.authority->step(all, run.world);
  EXPECT_FALSE(status.has_value());
  EXPECT_EQ(run.world.step, before.step);
  EXPECT_EQ(run.world.x_m, before.x_m);
  EXPECT_EQ(run.authority->hash(), hash);
  EXPECT_EQ(run.authority->steps_done(), 10U);
  all.clear();
  for (const HostReport& report : run.reports) all.push_back(&report);
  EXPECT_TRUE(run.authority->step(all, run.world));
  EXPECT_TRUE(other.advance());
  EXPECT_EQ(run.hash(), other.hash());
  return status ? "" : status.error().text();
}

using Reports = std::vector<HostReport>;

TEST(SplitRefusal, ReportsOfAnotherStepOrHost) {
  EXPECT_EQ(refusal([](Reports& all) { all[1].step = 10; }),
            "host 1: a report for step 10, but step 11 is next");
  EXPECT_EQ(refusal([](Reports& all) { all[1].host = 7; }),
            "a report of host 7, but there are only 2");
  EXPECT_EQ(refusal([](Reports& all) { all.push_back(all[0]); }),
            "host 0: two reports for one step");
  EXPECT_EQ(refusal([](Reports& all) { all.pop_back(); }), "host 1 has not reported for step 11");
  const auto failed = [](Reports& all) {
    all[0].state = HostState::kFailed;
    all[0].text = "the line is dead";
  };
  EXPECT_EQ(refusal(failed), "host 0: cannot continue: the line is dead");
}

TEST(SplitRefusal, RobotsThatAreNotTheHosts) {
  EXPECT_EQ(refusal([](Reports& all) { all[0].proposals.robots[1] = 2; }),
            "host 0: robot `r2`: a proposal, but it runs on host 1");
  EXPECT_EQ(refusal([](Reports& all) { all[0].proposals.robots[1] = 9; }),
            "host 0: robot `number 9`: a proposal, but it does not exist");
  EXPECT_EQ(refusal([](Reports& all) { all[0].proposals.robots[1] = 0; }),
            "host 0: robot `r0`: a proposal twice");
  EXPECT_EQ(refusal([](Reports& all) { all[1].poses[1].robot = RobotId(2); }),
            "host 1: robot `r2`: a reported pose twice");
  EXPECT_EQ(refusal([](Reports& all) { all[1].poses.pop_back(); }),
            "host 1: robot `r3`: missing among those that have a reported pose");
  EXPECT_EQ(refusal([](Reports& all) {
              all[0].poses.push_back({RobotId(0), {}});
            }),
            "host 0: robot `r0`: a reported pose, which it was not asked for");
  EXPECT_EQ(refusal([](Reports& all) { all[0].proposals.vx_mps.pop_back(); }),
            "host 0: proposals of unequal length");
  const auto sample = [](Reports& all) { all[0].samples.push_back({RobotId(0), {}, {}}); };
  EXPECT_EQ(refusal(sample), "host 0: robot `r0`: a sample of its pose from another host");
}

TEST(SplitRefusal, NumbersThatAreNone) {
  for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(refusal([bad](Reports& all) { all[0].proposals.wz_radps[0] = bad; }),
              "host 0: robot `r0`: proposes a velocity that is not finite");
    EXPECT_EQ(refusal([bad](Reports& all) { all[1].poses[0].reported.pose.yaw_rad = bad; }),
              "host 1: robot `r2`: a reported pose that is not finite");
    EXPECT_EQ(refusal([bad](Reports& all) { all[1].poses[0].reported.velocity.vx = bad; }),
              "host 1: robot `r2`: a reported pose that is not finite");
    EXPECT_EQ(refusal([bad](Reports& all) { all[1].samples.at(0).X_WR.x = bad; }),
              "host 1: robot `r2`: a sample that is not finite");
    EXPECT_EQ(refusal([bad](Reports& all) { all[0].sent.packets.at(0).x_m = bad; }),
              "host 0: robot `r0`: a message with a position or range that is not finite");
  }
  EXPECT_EQ(refusal([](Reports& all) { all[1].poses[0].reported.stamp.ns += 1'000'000'000; }),
            "host 1: robot `r2`: a reported pose from the future");
}

TEST(SplitRefusal, MessagesThatCannotBe) {
  const auto spoilt = [](const std::function<void(SentPacket&)>& spoil) {
    return refusal([&](Reports& all) { spoil(all[0].sent.packets.at(1)); });
  };
  EXPECT_EQ(spoilt([](SentPacket& packet) { packet.robot = RobotId(3); }),
            "host 0: robot `r3`: a message from another host");
  EXPECT_EQ(spoilt([](SentPacket& packet) { packet.robot = RobotId(99); }),
            "host 0: robot `number 99`: a message from another host");
  EXPECT_EQ(spoilt([](SentPacket& packet) { packet.robot = RobotId(0); }),
            "host 0: robot `r0`: messages out of order");
  EXPECT_EQ(spoilt([](SentPacket& packet) { packet.communicator = 1; }),
            "host 0: robot `r1`: a message of a communicator that it does not have");
  EXPECT_EQ(spoilt([](SentPacket& packet) { packet.first_byte = 0xFFFF'FFFFU; }),
            "host 0: robot `r1`: a message with missing bytes");
  EXPECT_EQ(spoilt([](SentPacket& packet) { packet.size = 70'000; }),
            "host 0: robot `r1`: a message with missing bytes");
  EXPECT_EQ(spoilt([](SentPacket& packet) { packet.complete_ns += 1'000'000'000; }),
            "host 0: robot `r1`: a message for another step");
  EXPECT_EQ(spoilt([](SentPacket& packet) { packet.to.kind = RecipientKind{7}; }),
            "host 0: robot `r1`: a message without receiver");
}

/// The error with which a host answers a world that was changed like this.
std::string world_refusal(const std::function<void(WorldStep&)>& spoil) {
  SplitRun run(four, kFourOn);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(run.advance());
  WorldStep spoilt = run.world;
  spoil(spoilt);
  const Status status = run.hosts[0]->apply(spoilt);
  // Nothing has changed.
  EXPECT_TRUE(run.advance());
  return status ? "" : status.error().text();
}

TEST(SplitRefusal, WorldsThatCannotBe) {
  EXPECT_EQ(world_refusal([](WorldStep& world) { ++world.step; }),
            "the world is for step 4, but step 3 is next");
  EXPECT_EQ(world_refusal([](WorldStep& world) { world.x_m.pop_back(); }),
            "a world of 3 robots, but there are 4");
  EXPECT_EQ(world_refusal([](WorldStep& world) { world.yaw_rad[2] = kNan; }),
            "a world with a pose that is not finite");
  EXPECT_EQ(world_refusal([](WorldStep& world) {
              world.pushed.push_back({RobotId(9), {}});
            }),
            "robot `number 9`: pushed to an invalid pose");
  EXPECT_EQ(world_refusal([](WorldStep& world) {
              world.touches.push_back({RobotId(1), {kNan, 0}});
            }),
            "robot `r1`: touches something at an invalid place");
  EXPECT_EQ(world_refusal([](WorldStep& world) {
              world.resized.push_back({RobotId(1), kNan});
            }),
            "robot `r1`: an impossible size of a body");
  EXPECT_EQ(world_refusal([](WorldStep& world) { world.inputs.emplace_back().robot = RobotId(9); }),
            "robot `number 9`: an invalid input");
}

TEST(SplitRefusal, CallsOutOfTurn) {
  SplitRun run(four, kFourOn);
  Engine& host = *run.hosts[0];
  EXPECT_EQ(host.step().error().code, ErrorCode::kState);
  HostReport report;
  EXPECT_EQ(host.propose(report).error().text(), "step 0 has been proposed: apply() comes next");
  ASSERT_TRUE(host.apply(run.world));
  EXPECT_EQ(host.apply(run.world).error().text(), "step 0 has begun: propose() comes next");
  ASSERT_TRUE(host.propose(report));
  EXPECT_EQ(report.step, 1U);
  const auto alone = make_engine(four());
  EXPECT_EQ(alone->propose(report).error().code, ErrorCode::kState);
  EXPECT_EQ(alone->apply(run.world).error().code, ErrorCode::kState);
}

TEST(SplitRefusal, AtCreation) {
  const auto error_of = [](auto change) {
    EngineSpec spec = four();
    spec.local = {RobotId(0), RobotId(1)};
    change(spec);
    const auto engine = Engine::create(std::move(spec));
    return engine ? std::string() : engine.error().text();
  };
  EXPECT_EQ(error_of([](EngineSpec&) {}), "");
  EXPECT_EQ(error_of([](EngineSpec& spec) { spec.local->clear(); }),
            "expected at least one robot for the host");
  EXPECT_EQ(error_of([](EngineSpec& spec) { spec.local->emplace_back(4); }),
            "robot 4 is local, but there are 4 robots");
  EXPECT_EQ(error_of([](EngineSpec& spec) { spec.local->emplace_back(0); }),
            "robot `r0` is local twice");
  PlacedClock clock;
  EXPECT_EQ(error_of([&](EngineSpec& spec) { spec.live_clock = &clock; }),
            "hosts in lock-step cannot share a live run: its drivers do not wait");
  EXPECT_EQ(error_of([&](EngineSpec& spec) {
              spec.live_clock = &clock;
              spec.own_authority = true;
            }),
            "");
  const auto mixed = [](EngineSpec& spec) {
    const ParameterChange body{ParameterChange::Part::kBody, 0, "scale", 1.1};
    const ParameterChange speed{ParameterChange::Part::kProgram, 0, "v", 1.0};
    spec.changes.push_back({5, RobotId(0), {body}});
    spec.changes.push_back({5, RobotId(0), {speed}});
  };
  EXPECT_EQ(error_of(mixed),
            "robot `r0`, step 5: its body and other parts change in one step, which runs of "
            "several hosts do not support; change the body a step earlier");
  EngineSpec spec = four();
  mixed(spec);
  EXPECT_FALSE(WorldAuthority::create(std::move(spec), kFourOn));
  EXPECT_EQ(WorldAuthority::create(four(), {0, 0, 2, 2}).error().text(),
            "host 1 runs no robot, but there is a host 2");
  EXPECT_EQ(WorldAuthority::create(four(), {0, 0}).error().text(),
            "hosts for 2 robots, but there are 4");
}

TEST(SplitRefusal, AModelOfTheRadioThatFailsEndsTheRun) {
  const auto make = [] {
    EngineSpec spec;
    RobotType type = talking_type({{"count", 1}}, {{"throws", 1}});
    add_robot(spec, std::move(type));
    add_twin(spec, {1, 0, 0});
    return spec;
  };
  SplitRun run(make, {0, 1});
  ASSERT_TRUE(run.advance());
  const Status status = run.hosts[0]->apply(run.world);
  ASSERT_FALSE(status.has_value());
  EXPECT_NE(status.error().text().find("communicator `air` (driver `model`)"), std::string::npos);
}

TEST(SplitRefusal, InputsThatCannotBeCarriedOut) {
  SplitRun run(four, kFourOn);
  WorldInput input;
  input.robot = RobotId(4);
  EXPECT_FALSE(run.authority->ask(input));
  input.robot = RobotId(2);
  input.action = Change();
  EXPECT_FALSE(run.authority->ask(input));
  const ParameterChange body{ParameterChange::Part::kBody, 0, "scale", 1.1};
  const ParameterChange speed{ParameterChange::Part::kProgram, 0, "speed", 1.0};
  input.action = Change{{body, speed}};
  EXPECT_FALSE(run.authority->ask(input));
  input.action = Change{{body}};
  ASSERT_EQ(run.authority->ask(input), 1U);
  ASSERT_TRUE(run.advance());
  ASSERT_EQ(run.authority->refusals().size(), 1U);
  EXPECT_EQ(run.authority->refusals()[0].text,
            "robot `r2`, body: a real body cannot change its size");
  input.robot = RobotId(0);
  input.action = Change{{speed}};
  ASSERT_EQ(run.authority->ask(input), 2U);
  ASSERT_TRUE(run.advance());
  EXPECT_TRUE(run.authority->refusals().empty());
  ASSERT_TRUE(run.advance());
  ASSERT_EQ(run.authority->refusals().size(), 1U);
  EXPECT_EQ(run.authority->refusals()[0].sequence, 2U);
  EXPECT_EQ(run.hosts[0]->set_parameters(RobotId(2), {{speed}}).error().text(),
            "robot `r2` runs on another host");
  EXPECT_EQ(run.hosts[0]->set_parameters(RobotId(0), {{body}}).error().text(),
            "only the authority can change the body of robot `r0`");
}

ObstacleChange crate(const Pose2& X_WB) {
  ObstacleChange change;
  change.name = "crate";
  change.X_WB = X_WB;
  change.body = box({}, 0.2, 0.2).body;
  return change;
}

TEST(SplitRefusal, ObstaclesOfAWorldThatCannotBe) {
  // No obstacle, four robots: the next body is number 4.
  const auto with = [](std::vector<ObstacleChange> changes) {
    return world_refusal([&](WorldStep& world) { world.obstacles = std::move(changes); });
  };
  ObstacleChange next = crate({9, 9, 0});
  next.id = BodyId(4);
  ObstacleChange gap = next;
  gap.id = BodyId(5);
  EXPECT_EQ(with({gap}), "obstacle `crate`, number 5: added, but number 4 comes next");
  EXPECT_EQ(with({next, next}), "obstacle `crate`, number 4: added, but number 5 comes next");
  ObstacleChange nowhere = next;
  nowhere.X_WB.x = kNan;
  EXPECT_EQ(with({nowhere}), "obstacle `crate`: x is nan; expected within +-10000000 m");
  ObstacleChange gone = next;
  gone.kind = ObstacleChange::Kind::kRemove;
  EXPECT_EQ(with({next, gone, gone}),
            "obstacle `crate`, number 4: changed, but there is no such obstacle");
  gone.id = BodyId(0);
  EXPECT_EQ(with({gone}), "obstacle `crate`, number 0: changed, but there is no such obstacle");
  EXPECT_EQ(world_refusal(
                [](WorldStep& world) { world.inputs.emplace_back().action = ObstacleChange(); }),
            "robot `number 4294967295`: an invalid input");
}

TEST(SplitRefusal, ObstaclesThatNobodyCanHave) {
  SplitRun run(four, kFourOn);
  WorldInput input;
  input.action = crate({kNan, 0, 0});
  EXPECT_FALSE(run.authority->ask(input));
  input.action = crate({0.1, 0, 0});
  ASSERT_EQ(run.authority->ask(input), 1U);
  input.action = crate({5, 5, 0});
  ASSERT_EQ(run.authority->ask(input), 2U);
  ASSERT_EQ(run.authority->ask(input), 3U);
  ASSERT_TRUE(run.advance());
  ASSERT_EQ(run.authority->refusals().size(), 2U);
  EXPECT_EQ(run.authority->refusals()[0].sequence, 1U);
  EXPECT_NE(run.authority->refusals()[0].text.find("overlap the robot `r0`"), std::string::npos);
  EXPECT_NE(run.authority->refusals()[1].text.find("there already is an obstacle `crate`"),
            std::string::npos);
  ASSERT_EQ(run.world.obstacles.size(), 1U);
  EXPECT_EQ(run.world.obstacles[0].id, BodyId(4));
  ASSERT_TRUE(run.advance());
  EXPECT_TRUE(run.world.obstacles.empty());
  EXPECT_EQ(run.hosts[1]->spec().world.added.at(0).body.name, "crate");
  EXPECT_EQ(run.authority->world().added.size(), 1U);
  EXPECT_EQ(run.hosts[0]->change_obstacle(crate({6, 6, 0})).error().text(),
            "only the authority can change obstacles");
}

TEST(SplitHost, AFailedDriverStandsInTheReport) {
  EngineSpec spec = four();
  spec.types.back().sensors[0] = real_sensor<Recording>("mocap", {{"silent", 1}});
  spec.local = {RobotId(2)};
  spec.host_timeout = std::chrono::milliseconds(20);
  const auto host = make_engine(std::move(spec));
  HostReport report;
  report.host = 5;
  EXPECT_EQ(host->propose(report).error().code, ErrorCode::kTimeout);
  EXPECT_EQ(report.host, 5U);
  EXPECT_EQ(report.state, HostState::kFailed);
  EXPECT_NE(report.text.find("has not declared"), std::string::npos);
}

}  // namespace
}  // namespace rave::sim::testing
