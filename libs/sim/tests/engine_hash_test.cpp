// SPDX-License-Identifier: Apache-2.0
#include <thread>

#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::sim::testing {
namespace {

constexpr int kSteps = 120;
constexpr std::uint32_t kRoamers = 140;  // more than two blocks

/// Stands in for a program in a process of its own: decides in a thread of its own.
class InThread final : public ProgramProcess {
 public:
  explicit InThread(const ProgramSetup& setup) {
    ErrorText error;
    status_ = program_table<Roam>()->start(&program_, &setup, &error);
  }
  ~InThread() override { wait(); }
  Status begin(const DecideItem& item) override {
    thread_ = std::thread([this, &item] {
      ErrorText error;
      program_table<Roam>()->decide(&program_, sizeof program_, &item, 1, &failed_, &error);
    });
    return {};
  }
  Status end(const DecideItem&) override {
    wait();
    if (failed_ != 0 || status_ != 0) return fail(ErrorCode::kPlugin, "failed");
    return {};
  }

 private:
  void wait() {
    if (thread_.joinable()) thread_.join();
  }
  Roam program_;
  int status_ = 0;
  std::uint8_t failed_ = 0;
  std::thread thread_;
};

SensorSpec noisy_laser() {
  SensorSpec sensor = laser(16, 4, 2, 2);
  sensor.processing.noise.length_sigma_m = 0.01;
  sensor.processing.noise.dropout_probability = 0.05;
  sensor.processing.latency_s = 0.025;
  sensor.processing.filters = {{FilterSpec::Kind::kMedian, 3, 0}};
  return sensor;
}

/// A crowded room with all that could go wrong: noise, latency, filters, reported poses, programs
/// aside, real robots that plough through the crowd.
EngineSpec busy_world(unsigned threads, std::uint64_t seed = 7, bool hermit = false) {
  EngineSpec spec;
  spec.threads = threads;
  spec.seed = seed;
  spec.history = from_seconds(0.2);
  for (const Pose2& side : {Pose2{-0.5, 3, 0}, {6.5, 3, 0}}) {
    spec.world.obstacles.push_back(box(side, 0.1, 8));
  }
  for (const Pose2& side : {Pose2{3, -0.5, 0}, {3, 6.5, 0}}) {
    spec.world.obstacles.push_back(box(side, 8, 0.1));
  }
  RobotType roamer = simulated_type({{"shake", 0.1}});
  roamer.sensors.push_back(noisy_laser());
  roamer.sensors.push_back(virtual_sensor<Counter>("counter", {}, 3));
  roamer.program = program<Roam>({}, 2, 1);
  add_robot(spec, std::move(roamer), {0, 0, 0});
  for (std::uint32_t i = 1; i < kRoamers; ++i) {
    const std::uint32_t row = i / 12;
    add_twin(spec, {0.45 * (i % 12), 0.45 * row, 0.7 * (i % 9)});
  }
  RobotType guided = simulated_type();
  guided.sensors.push_back(noisy_laser());
  guided.sensors.push_back(virtual_sensor<Beacon>("beacon", {{"error_m", 0.1}}, 5));
  guided.sensors[1].processing.latency_s = 0.02;
  guided.pose_from = 1;
  guided.program = program<Roam>({}, 3);
  guided.program->isolate =
      [](const ProgramSetup& setup) -> Result<std::unique_ptr<ProgramProcess>> {
    return std::make_unique<InThread>(setup);
  };
  add_robot(spec, std::move(guided), {0, 5.8, 0});
  add_twin(spec, {2, 5.8, 2});
  RobotType real = real_type({{"x", 0.2}, {"y", 0.2}, {"vx", 1.5}, {"vy", 1.3}, {"first_s", 0.15}});
  real.sensors[0].processing.noise.length_sigma_m = 0.003;
  real.sensors[0].processing.latency_s = 0.012;
  real.sensors.push_back(laser(8, 6, 2));
  real.sensors.push_back(real_sensor<Ticker>("ticker", {{"period_s", 0.004}, {"room", 16}}));
  real.sensors.back().processing.latency_s = 0.033;
  real.program = program<Drive>({{"v", 0.1}}, 4);
  add_robot(spec, std::move(real));
  if (hermit) {
    RobotType type = simulated_type();
    type.program = program<Drive>({{"v", 3}, {"w", 1}});
    add_robot(spec, std::move(type), {100, 100, 0});
  }
  return spec;
}

TEST(EngineHash, IsTheSameForAnyNumberOfThreads) {
  const auto one = make_engine(busy_world(1));
  const auto events = run(*one, kSteps);
  // The world is as busy as it is meant to be.
  EXPECT_GT(of_kind(events, EventKind::kContact).size(), 20U);
  EXPECT_TRUE(of_kind(events, EventKind::kProgramFailed).empty());
  EXPECT_TRUE(of_kind(events, EventKind::kDriverFailed).empty());
  for (const unsigned threads : {2U, 3U, 8U}) {
    const auto many = make_engine(busy_world(threads));
    const auto others = run(*many, kSteps);
    EXPECT_EQ(many->hash(), one->hash()) << threads << " threads";
    ASSERT_EQ(others.size(), events.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
      EXPECT_EQ(others[i].step, events[i].step);
      EXPECT_EQ(others[i].robot, events[i].robot);
      EXPECT_EQ(others[i].kind, events[i].kind);
      EXPECT_EQ(others[i].text, events[i].text);
    }
  }
}

TEST(EngineHash, NoiseInPlaceIsTheNoiseOfTheChain) {
  // A median of one reading changes nothing, but sends the samples through the chain.
  const auto hash_with = [](double sigma_m, const std::vector<FilterSpec>& filters,
                            unsigned threads) {
    EngineSpec spec = busy_world(threads);
    for (RobotType& type : spec.types) {
      for (SensorSpec& sensor : type.sensors) {
        if (sensor.virtual_ops == nullptr || sensor.kind != ReadingKind::kRanges) continue;
        sensor.processing = {};
        sensor.processing.noise.length_sigma_m = sigma_m;
        sensor.processing.filters = filters;
      }
    }
    const auto engine = make_engine(std::move(spec));
    run(*engine, kSteps);
    return engine->hash();
  };
  const RunHash in_place = hash_with(0.02, {}, 1);
  EXPECT_EQ(in_place, hash_with(0.02, {{FilterSpec::Kind::kMedian, 1, 0}}, 1));
  EXPECT_EQ(in_place, hash_with(0.02, {}, 3));
  EXPECT_NE(in_place, hash_with(0.03, {}, 1));
}

TEST(EngineHash, IsTheSameAfterTenResetsInARow) {
  const auto engine = make_engine(busy_world(2));
  run(*engine, kSteps);
  const RunHash first = engine->hash();
  const Pose2 last = engine->true_pose(RobotId(17));
  for (int again = 0; again < 10; ++again) {
    ASSERT_TRUE(engine->reset().has_value());
    EXPECT_EQ(engine->steps_done(), 0U);
    EXPECT_EQ(engine->hash(), RunHash());
    // Some runs are left early, as a person would leave them.
    const int steps = again % 2 == 0 ? kSteps : 37;
    run(*engine, steps);
    if (steps != kSteps) continue;
    ASSERT_EQ(engine->hash(), first) << "reset " << again;
    ASSERT_EQ(engine->true_pose(RobotId(17)), last);
  }
}

TEST(EngineHash, NoticesOneBitOfOnePercept) {
  const auto plain = make_engine(busy_world(1));
  run(*plain, kSteps);
  for (const auto& [robot, sensor] : {std::pair{RobotId(90), 0U},
                                      {RobotId(90), 1U},
                                      {RobotId(kRoamers), 1U},
                                      {RobotId(kRoamers + 2), 0U}}) {
    const auto changed = make_engine(busy_world(1));
    run(*changed, kSteps - 10);
    changed->flip_percept_bit(robot, sensor);
    run(*changed, 10);
    EXPECT_NE(changed->hash(), plain->hash()) << robot.value() << ", sensor " << sensor;
    // A reset takes the change with it.
    ASSERT_TRUE(changed->reset().has_value());
    run(*changed, kSteps);
    EXPECT_EQ(changed->hash(), plain->hash());
  }
}

TEST(EngineHash, DiffersWithTheSeed) {
  const auto a = make_engine(busy_world(1, 7));
  const auto b = make_engine(busy_world(1, 8));
  run(*a, kSteps);
  run(*b, kSteps);
  EXPECT_NE(a->hash(), b->hash());
}

TEST(EngineHash, ARobotThatNobodyMeetsChangesNobodysTrack) {
  const auto without = make_engine(busy_world(1));
  const auto with = make_engine(busy_world(1, 7, true));
  for (int k = 0; k < kSteps; ++k) {
    run(*without, 1);
    run(*with, 1);
    for (std::uint32_t r = 0; r < without->spec().robots.size(); ++r) {
      ASSERT_EQ(with->true_pose(RobotId(r)), without->true_pose(RobotId(r)))
          << "robot " << r << " in step " << k;
    }
  }
  EXPECT_NE(with->hash(), without->hash());
}

}  // namespace
}  // namespace rave::sim::testing
