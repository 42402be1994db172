// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "split_drivers.hpp"
#include "split_run.hpp"

namespace rave::sim::testing {
namespace {

constexpr std::uint32_t kRobots = 30;
constexpr std::uint64_t kSteps = 320;
constexpr std::uint64_t kHandStep = 198;  // when a scan is taken, too
constexpr RobotId kStoppedByHand(2);
constexpr RobotId kChangedByHand(4);
constexpr RobotId kFailing(24);
constexpr RobotId kGrowing(21);

SensorSpec noisy_laser() {
  SensorSpec sensor = laser(16, 4, 2, 2);
  sensor.processing.noise.length_sigma_m = 0.01;
  sensor.processing.latency_s = 0.025;
  return sensor;
}

void add_radio(RobotType& type, Numbers model) {
  add_transmitter(type, 20'000);
  add_communicator(type, model);
}

/// Talks within a range and sight, with losses and a delay of a few steps.
RobotType talker(double v_mps, double throw_at = 0) {
  static constexpr VirtualActuatorOps kWagon = detail::virtual_actuator_ops<Wagon>();
  RobotType type = simulated_type({{"shake", 0.05}});
  type.actuators[0].virtual_ops = &kWagon;
  type.sensors.push_back(noisy_laser());
  type.sensors.push_back(virtual_sensor<Bumper>("bumper"));
  type.sensors.push_back(virtual_sensor<Feeler>("feeler"));
  add_radio(type, {{"range_m", 3},
                   {"sight", 1},
                   {"rate", 4000},
                   {"queue", 400},
                   {"overhead", 4},
                   {"delay_s", 0.004},
                   {"jitter_s", 0.04},
                   {"loss", 0.1}});
  type.program = program<Gossip>({{"v", v_mps}, {"throw_at", throw_at}}, 2, 1);
  type.program->param_specs = kGossipParams;
  return type;
}

/// Believes a beacon of its own; `careful` ones keep their distance. Talks without limits.
RobotType guided(bool careful) {
  RobotType type = simulated_type();
  type.sensors.push_back(noisy_laser());
  type.sensors.push_back(virtual_sensor<Beacon>("beacon", {{"error_m", 0.05}}, 5));
  type.sensors[0].processing = {};
  type.sensors[1].processing.latency_s = 0.02;
  type.pose_from = 1;
  type.guard = GuardSpec{};
  if (careful) type.guard->separation_m = 0.05;
  type.guard->max_speed_mps = 0.4;
  add_radio(type, {{"delay_s", 0.015}, {"loss", 0.2}});
  type.program = program<Gossip>({{"v", 0.6}, {"throw_at", 0}}, 3);
  type.program->param_specs = kGossipParams;
  return type;
}

/// A real robot that ploughs through the crowd; it has a hybrid laser and listens.
RobotType recorded(double x_m, double y_m, double vx_mps, double vy_mps, double first_s) {
  RobotType type = real_type({{"x", x_m},
                              {"y", y_m},
                              {"vx", vx_mps},
                              {"vy", vy_mps},
                              {"first_s", first_s},
                              {"gap_s", 1.2},
                              {"gap_end_s", 1.9}});
  type.sensors[0].processing.noise.length_sigma_m = 0.002;
  type.sensors.push_back(
      hybrid<ScanRecording, Laser, Nearest>({}, {{"rays", 2}, {"fov_rad", 0.6}, {"range_m", 6}}));
  type.sensors[1].layers = kAllLayers;
  type.sensors.push_back(real_sensor<Ticker>("ticker", {{"period_s", 0.004}, {"room", 16}}));
  add_radio(type, {{"range_m", 5}, {"delay_s", 0.01}});
  type.program = program<Gossip>({{"v", 0.1}, {"throw_at", 0}}, 4);
  return type;
}

void add_walls(EngineSpec& spec) {
  for (const Pose2& side : {Pose2{-0.5, 1.5, 0}, {3.5, 1.5, 0}}) {
    spec.world.obstacles.push_back(box(side, 0.1, 5));
  }
  for (const Pose2& side : {Pose2{1.5, -0.5, 0}, {1.5, 3.5, 0}}) {
    spec.world.obstacles.push_back(box(side, 5, 0.1));
  }
  spec.world.obstacles.push_back(box({1.5, 1.5, 0}, 0.5, 0.1));
}

void add_changes(EngineSpec& spec) {
  const auto to = [](const char* name, double value) {
    return ParameterChange{ParameterChange::Part::kProgram, 0, name, value};
  };
  const ParameterChange larger{ParameterChange::Part::kBody, 0, "scale", 1.1};
  const ParameterChange giant{ParameterChange::Part::kBody, 0, "scale", 9.0};
  spec.changes.push_back({3, kGrowing, {larger}});
  spec.changes.push_back({100, RobotId(5), {to("v", 0.9)}});
  spec.changes.push_back({100, RobotId(14), {to("v", 0.2)}});
  spec.changes.push_back({110, RobotId(6), {to("v", 99)}});  // refused by its host
  spec.changes.push_back({130, RobotId(22), {giant}});       // refused by the authority
  spec.changes.push_back({140, RobotId(26), {larger}});      // real: the same
}

ObstacleChange obstacle(ObstacleChange::Kind kind, const std::string& name, const Pose2& X_WB,
                        double side_m = 0.1) {
  ObstacleChange change;
  change.kind = kind;
  change.name = name;
  change.X_WB = X_WB;
  if (kind == ObstacleChange::Kind::kAdd) change.body = box({}, side_m, side_m).body;
  return change;
}

/// Posts between robots, one that hops over the wall and back, and what cannot be done.
void add_obstacle_changes(EngineSpec& spec) {
  using Kind = ObstacleChange::Kind;
  spec.obstacle_changes = {{5, obstacle(Kind::kAdd, "post", {0.9, 0.9, 0.3})},
                           {5, obstacle(Kind::kAdd, "hopper", {2.1, 0.9, 0})},
                           {6, obstacle(Kind::kAdd, "third", {2.1, 2.1, 0.7})},
                           {7, obstacle(Kind::kAdd, "fourth", {0.3, 1.5, 0})},
                           {7, obstacle(Kind::kAdd, "fifth", {1.5, 0.3, 0})},
                           {8, obstacle(Kind::kAdd, "sixth", {2.7, 1.5, 0})},
                           {60, obstacle(Kind::kMove, "hopper", {5, 5, 0})},
                           {70, obstacle(Kind::kAdd, "giant", {1.5, 1.5, 0}, 3)},  // refused
                           {120, obstacle(Kind::kRemove, "post", {})},
                           {125, obstacle(Kind::kRemove, "post", {})},  // refused
                           {260, obstacle(Kind::kMove, "third", {-2, 0, 0})},
                           {261, obstacle(Kind::kAdd, "post", {-3, 0, 0})}};
}

/// A crowded room with all that can pass between hosts.
EngineSpec scene(unsigned threads, std::uint64_t seed = 11) {
  EngineSpec spec;
  spec.threads = threads;
  spec.share_always = threads > 1;
  spec.seed = seed;
  add_walls(spec);
  const auto place = [](std::uint32_t i) {
    const std::uint32_t row = i / 6;
    return Pose2{0.6 * (i % 6), 0.6 * row, 0.7 * (i % 9)};
  };
  add_robot(spec, talker(0.5), place(0));
  for (std::uint32_t i = 1; i < 14; ++i) add_twin(spec, place(i));
  add_robot(spec, guided(false), place(14));
  for (std::uint32_t i = 15; i < 19; ++i) add_twin(spec, place(i));
  add_robot(spec, guided(true), place(19));
  add_robot(spec, simulated_type(), place(20));  // lets itself be pushed
  add_robot(spec, talker(0.4), place(21));
  RobotType blind = simulated_type({{"shake", 0.2}});
  blind.program = program<Drive>({{"v", 0.8}, {"w", 0.4}});
  add_robot(spec, std::move(blind), place(22));
  add_twin(spec, place(23));
  add_robot(spec, talker(0.7, 90), place(24));
  add_robot(spec, talker(0.3), place(25));
  add_robot(spec, recorded(-0.3, 0.1, 1.0, 0.8, 0), {});
  add_robot(spec, recorded(3.2, 0.4, -0.9, 0.7, 0.15), {});
  add_robot(spec, recorded(0.3, 3.2, 0.8, -0.9, 0.05), {});
  add_robot(spec, recorded(1.5, 3.2, 0.0, -0.9, 0.4), {});
  for (std::uint32_t r = 0; r < kRobots; ++r) {
    if (r % 5 != 4) spec.robots[r].team = r % 2 == 0 ? "red" : "blue";
  }
  add_changes(spec);
  add_obstacle_changes(spec);
  return spec;
}

std::vector<std::uint32_t> split(std::initializer_list<std::uint32_t> sizes) {
  std::vector<std::uint32_t> host_of;
  std::uint32_t host = 0;
  for (const std::uint32_t size : sizes) host_of.insert(host_of.end(), size, host++);
  return host_of;
}

std::vector<std::uint32_t> interleaved(std::uint32_t hosts) {
  std::vector<std::uint32_t> host_of(kRobots);
  for (std::uint32_t r = 0; r < kRobots; ++r) host_of[r] = r % hosts;
  return host_of;
}

/// The box in the middle goes.
ObstacleChange removed_by_hand() {
  ObstacleChange change;
  change.kind = ObstacleChange::Kind::kRemove;
  change.id = BodyId(4);
  return change;
}
ParameterChange speed_by_hand() { return {ParameterChange::Part::kProgram, 0, "v", 1.0}; }

/// What happened in a run of one engine, and its hash after each step.
struct Track {
  std::vector<std::vector<Event>> events;
  std::vector<RunHash> hashes;
  RadioCounts counts;
};

Track alone(unsigned threads) {
  Track track;
  const auto engine = make_engine(scene(threads));
  for (std::uint64_t k = 0; k < kSteps; ++k) {
    if (k == kHandStep) {
      engine->stop(kStoppedByHand);
      const ParameterChange changes[] = {speed_by_hand()};
      EXPECT_TRUE(engine->set_parameters(kChangedByHand, changes));
      EXPECT_TRUE(engine->change_obstacle(removed_by_hand()));
    }
    track.events.push_back(run(*engine, 1));
    track.hashes.push_back(engine->hash());
  }
  track.counts = engine->radio_counts();
  return track;
}

const Track& reference() {
  static const Track kTrack = alone(1);
  return kTrack;
}

void expect_same(const std::vector<Event>& split, const std::vector<Event>& one) {
  ASSERT_EQ(split.size(), one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(split[i].step, one[i].step);
    EXPECT_EQ(split[i].robot, one[i].robot);
    EXPECT_EQ(split[i].kind, one[i].kind) << split[i].text << " / " << one[i].text;
    EXPECT_EQ(split[i].other, one[i].other);
    EXPECT_EQ(split[i].text, one[i].text);
  }
}

/// What hosts are told of the step that is done.
void expect_same_contacts(const std::vector<Event>& told, std::uint64_t step) {
  std::vector<Event> expected = reference().events[step];
  std::erase_if(expected, [](const Event& event) {
    return event.kind != EventKind::kContact && event.kind != EventKind::kPinned;
  });
  ASSERT_EQ(told.size(), expected.size()) << "step " << step;
  for (std::size_t i = 0; i < told.size(); ++i) {
    ASSERT_EQ(told[i].step, step);
    ASSERT_EQ(told[i].robot, expected[i].robot) << "step " << step;
    ASSERT_EQ(told[i].kind, expected[i].kind) << "step " << step;
    ASSERT_EQ(told[i].other, expected[i].other) << "step " << step;
  }
}

void ask_by_hand(WorldAuthority& authority) {
  WorldInput stop;
  stop.robot = kStoppedByHand;
  ASSERT_TRUE(authority.ask(stop));
  WorldInput change;
  change.kind = WorldInput::Kind::kChange;
  change.robot = kChangedByHand;
  change.changes = {speed_by_hand()};
  ASSERT_TRUE(authority.ask(change));
  WorldInput obstacle;
  obstacle.kind = WorldInput::Kind::kObstacle;
  obstacle.obstacle = removed_by_hand();
  ASSERT_TRUE(authority.ask(obstacle));
}

/// Runs the scene on these hosts and compares each step with one engine.
void expect_the_same_run(const std::vector<std::uint32_t>& host_of, unsigned threads) {
  SplitRun run([threads] { return scene(threads); }, host_of);
  ASSERT_NE(run.authority, nullptr);
  for (std::uint64_t k = 0; k < kSteps; ++k) {
    // The world of step k + 1 is made at the end of step k.
    if (k + 1 == kHandStep) ask_by_hand(*run.authority);
    ASSERT_TRUE(run.advance());
    ASSERT_EQ(run.authority->steps_done(), k + 1);
    ASSERT_EQ(run.hosts[0]->steps_done(), k + 1);
    ASSERT_NO_FATAL_FAILURE(expect_same(run.events(), reference().events[k])) << "step " << k;
    ASSERT_EQ(run.hash(), reference().hashes[k]) << "step " << k;
  }
  ASSERT_TRUE(run.apply());
  EXPECT_EQ(run.radio_counts(), reference().counts);
  EXPECT_TRUE(run.authority->refusals().empty());
}

TEST(Split, TheSceneIsAsBusyAsItIsMeantToBe) {
  std::vector<Event> all;
  for (const auto& step : reference().events) all.insert(all.end(), step.begin(), step.end());
  EXPECT_GT(of_kind(all, EventKind::kContact).size(), 60U);
  EXPECT_GE(of_kind(all, EventKind::kPinned).size(), 1U);
  EXPECT_EQ(of_kind(all, EventKind::kProgramFailed).size(), 1U);
  EXPECT_EQ(of_kind(all, EventKind::kProgramFailed)[0].robot, kFailing);
  EXPECT_EQ(of_kind(all, EventKind::kChanged).size(), 4U);
  EXPECT_EQ(of_kind(all, EventKind::kChangeRefused).size(), 5U);
  EXPECT_EQ(of_kind(all, EventKind::kObstacleAdded).size(), 7U);
  EXPECT_EQ(of_kind(all, EventKind::kObstacleMoved).size(), 2U);
  EXPECT_EQ(of_kind(all, EventKind::kObstacleRemoved).size(), 2U);
  const auto contacts = of_kind(all, EventKind::kContact);
  const auto with_new = std::count_if(contacts.begin(), contacts.end(), [](const Event& event) {
    return event.other.value() >= 5 + kRobots;
  });
  EXPECT_GE(with_new, 4) << "robots run into what has come";
  EXPECT_EQ(of_kind(all, EventKind::kStopped).size(), 1U);
  EXPECT_GE(of_kind(all, EventKind::kPoseStale).size(), 4U);
  EXPECT_GE(of_kind(all, EventKind::kPoseBack).size(), 4U);
  EXPECT_GE(of_kind(all, EventKind::kGuardSlowed).size(), 5U);
  const RadioCounts& counts = reference().counts;
  EXPECT_GT(counts.delivered, 1000U);
  EXPECT_GT(counts.lost_range, 100U);
  EXPECT_GT(counts.lost_obstacle, 100U);
  EXPECT_GT(counts.lost_chance, 100U);
}

TEST(Split, OneHostOfAllRobots) { expect_the_same_run(split({30}), 1); }
TEST(Split, OneHostOfAllRobotsOnThreeThreads) { expect_the_same_run(split({30}), 3); }
TEST(Split, OneRobotAndTheRest) { expect_the_same_run(split({1, 29}), 1); }
TEST(Split, OneRobotAndTheRestOnThreeThreads) { expect_the_same_run(split({1, 29}), 3); }
TEST(Split, TheRestAndOneRealRobot) { expect_the_same_run(split({29, 1}), 1); }
TEST(Split, ThreeHosts) { expect_the_same_run(split({10, 10, 10}), 1); }
TEST(Split, ThreeHostsOnThreeThreads) { expect_the_same_run(split({10, 10, 10}), 3); }
TEST(Split, ThreeHostsInterleaved) { expect_the_same_run(interleaved(3), 1); }
TEST(Split, ThreeHostsInterleavedOnThreeThreads) { expect_the_same_run(interleaved(3), 3); }
TEST(Split, AHostForEachRobot) { expect_the_same_run(interleaved(kRobots), 1); }

TEST(Split, TheSumNoticesOneBitOfOnePercept) {
  for (const auto& [robot, sensor] : {std::pair{RobotId(7), 0U}, {RobotId(28), 1U}}) {
    SplitRun run([] { return scene(1); }, interleaved(3));
    for (int k = 0; k < 50; ++k) ASSERT_TRUE(run.advance());
    ASSERT_EQ(run.hash(), reference().hashes[49]);
    run.hosts[robot.value() % 3]->flip_percept_bit(robot, sensor);
    for (int k = 50; k < 60; ++k) ASSERT_TRUE(run.advance());
    EXPECT_NE(run.hash(), reference().hashes[59]) << robot.value();
  }
}

TEST(Split, TheSumNoticesTheLastBitOfOneProposal) {
  SplitRun run([] { return scene(1); }, interleaved(3));
  for (int k = 0; k < 50; ++k) ASSERT_TRUE(run.advance());
  ASSERT_TRUE(run.apply());
  std::vector<const HostReport*> all;
  for (std::size_t h = 0; h < run.hosts.size(); ++h) {
    ASSERT_TRUE(run.hosts[h]->propose(run.reports[h]));
    all.push_back(&run.reports[h]);
  }
  double& vx_mps = run.reports[1].proposals.vx_mps[0];
  vx_mps = std::nextafter(vx_mps, 9.0);
  ASSERT_TRUE(run.authority->step(all, run.world));
  EXPECT_NE(run.hash(), reference().hashes[50]);
}

TEST(Split, TheMessageToTheHostsDoesNotDependOnTheSplit) {
  SplitRun one([] { return scene(1); }, split({30}));
  SplitRun three([] { return scene(1); }, interleaved(3));
  for (int k = 0; k < 100; ++k) {
    ASSERT_TRUE(one.advance());
    ASSERT_TRUE(three.advance());
    ASSERT_EQ(one.world.x_m, three.world.x_m);
    ASSERT_EQ(one.world.wz_radps, three.world.wz_radps);
    ASSERT_EQ(one.world.flags, three.world.flags);
    ASSERT_EQ(one.world.sent.bytes, three.world.sent.bytes);
    ASSERT_EQ(one.world.sent.packets.size(), three.world.sent.packets.size());
    ASSERT_EQ(one.world.touches.size(), three.world.touches.size());
    ASSERT_EQ(one.world.samples.size(), three.world.samples.size());
    ASSERT_EQ(one.world.obstacles.size(), three.world.obstacles.size());
    for (std::size_t i = 0; i < one.world.obstacles.size(); ++i) {
      ASSERT_EQ(one.world.obstacles[i].id, three.world.obstacles[i].id);
    }
  }
}

TEST(Split, ANewAuthorityGoesOnToTheBit) {
  SplitRun run([] { return scene(1); }, interleaved(3));
  for (std::uint64_t k = 0; k < kSteps; ++k) {
    if (k + 1 == kHandStep) ask_by_hand(*run.authority);
    if (k % 7 == 6) {
      auto successor = WorldAuthority::create(scene(1), interleaved(3));
      ASSERT_TRUE(successor) << successor.error().text();
      const Status resumed = (*successor)->resume(run.world, run.authority->state());
      ASSERT_TRUE(resumed) << resumed.error().text();
      // What was asked for and not told to anybody is gone with the first.
      if (k + 1 == kHandStep) ask_by_hand(**successor);
      run.authority = *std::move(successor);
    }
    ASSERT_TRUE(run.advance());
    ASSERT_EQ(run.authority->steps_done(), k + 1);
    ASSERT_EQ(run.hash(), reference().hashes[k]) << "step " << k;
    ASSERT_NO_FATAL_FAILURE(expect_same_contacts(run.authority->state().done, k));
  }
}

TEST(Split, AnAuthorityOfAnotherWorldDoesNotGoOn) {
  SplitRun run([] { return scene(1); }, interleaved(3));
  AuthorityState state = run.authority->state();
  WorldStep small = run.world;
  small.x_m.pop_back();
  const Status other = run.authority->resume(small, state);
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("a world of 29 robots, but there are 30"), std::string::npos)
      << other.error().message;
  state.pinned = {RobotId(kRobots)};
  EXPECT_FALSE(run.authority->resume(run.world, state));
  EXPECT_TRUE(run.advance());
}

TEST(Split, TheOthersGoOnWithoutAHostAndItComesBack) {
  constexpr std::uint32_t kHost = 1;
  SplitRun run([] { return scene(1); }, interleaved(3));
  for (int k = 0; k < 60; ++k) ASSERT_TRUE(run.advance());
  run.hosts[kHost] = nullptr;
  const auto step_without = [&] {
    std::vector<const HostReport*> reports;
    for (std::uint32_t h = 0; h < 3; ++h) {
      if (h == kHost) {
        run.authority->speak_for(h, run.reports[h]);
      } else {
        ASSERT_TRUE(run.hosts[h]->apply(run.world));
        ASSERT_TRUE(run.hosts[h]->propose(run.reports[h]));
      }
      reports.push_back(&run.reports[h]);
    }
    const Status stepped = run.authority->step(reports, run.world);
    ASSERT_TRUE(stepped) << stepped.error().text();
  };
  for (int k = 0; k < 20; ++k) ASSERT_NO_FATAL_FAILURE(step_without());
  std::size_t moving = 0;
  for (std::uint32_t r = kHost; r < kRobots; r += 3) {
    const bool stands = run.world.vx_mps[r] == 0 && run.world.wz_radps[r] == 0;
    moving += stands ? 0U : 1U;
  }
  EXPECT_EQ(moving, 0U);

  EngineSpec spec = scene(1);
  spec.local.emplace();
  for (std::uint32_t r = kHost; r < kRobots; r += 3) spec.local->emplace_back(r);
  run.hosts[kHost] = make_engine(std::move(spec));
  ASSERT_TRUE(run.hosts[kHost]->propose(run.reports[kHost]));
  EXPECT_EQ(run.reports[kHost].step, 0U);
  const Status joined = run.hosts[kHost]->join(run.world, run.authority->state());
  ASSERT_TRUE(joined) << joined.error().text();
  // It grew before this host was there.
  EXPECT_NE(scene(1).world.robots[kGrowing.value()].radius_m(),
            run.hosts[0]->body_radius_m(kGrowing));
  EXPECT_EQ(run.hosts[kHost]->body_radius_m(kGrowing), run.hosts[0]->body_radius_m(kGrowing));
  ASSERT_TRUE(run.hosts[0]->apply(run.world));
  ASSERT_TRUE(run.hosts[2]->apply(run.world));
  ASSERT_TRUE(run.exchange());
  EXPECT_EQ(run.reports[kHost].step, run.reports[0].step);
  for (int k = 0; k < 40; ++k) ASSERT_TRUE(run.advance());
  for (std::uint32_t r = kHost; r < kRobots; r += 3) {
    moving += run.world.vx_mps[r] != 0 || run.world.wz_radps[r] != 0 ? 1U : 0U;
  }
  EXPECT_GT(moving, 5U);
}

TEST(Split, AResetOfAllBeginsTheSameRun) {
  SplitRun run([] { return scene(2); }, interleaved(3));
  for (int k = 0; k < 150; ++k) ASSERT_TRUE(run.advance());
  for (int again = 0; again < 2; ++again) {
    run.authority->reset();
    for (auto& host : run.hosts) ASSERT_TRUE(host->reset());
    EXPECT_EQ(run.hash(), RunHash());
    ASSERT_TRUE(run.exchange());
    for (int k = 0; k < 150; ++k) ASSERT_TRUE(run.advance());
    EXPECT_EQ(run.hash(), reference().hashes[149]);
  }
}

}  // namespace
}  // namespace rave::sim::testing
