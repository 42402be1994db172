// SPDX-License-Identifier: Apache-2.0
// Whether a record holds where each robot was and was told to be, in every step.
#include "rave/recording/record_keeper.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_reader.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace rave::runtime::testing {
namespace {

/// What a record should say of one robot in one step.
struct Place {
  std::optional<Pose2> truth;
  std::optional<Pose2> reported;
};

bool same(const std::optional<Pose2>& a, const std::optional<Pose2>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return a->x == b->x && a->y == b->y && a->yaw == b->yaw;
}

std::vector<Place> places_in(const sim::Engine& engine) {
  const sim::EngineSpec& spec = engine.spec();
  std::vector<Place> places;
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    Place& place = places.emplace_back();
    if (spec.types[spec.robots[r].type].simulated) {
      place.truth = engine.snapshot().pose(RobotId(r));
    }
    const sim::ReportedPose& reported = engine.reported(RobotId(r));
    if (reported.known) {
      place.reported = Pose2{reported.pose.x_m, reported.pose.y_m, reported.pose.yaw_rad};
    }
  }
  return places;
}

/// A real robot comes late and drives through simulated ones, which make way for it.
sim::EngineSpec crowd_with_a_late_robot() {
  using sim::testing::add_robot;
  using sim::testing::add_twin;
  sim::EngineSpec spec;
  add_robot(spec, sim::testing::simulated_type(), {0, 0.05, 0});
  add_twin(spec, {1, -0.05, 0.3});
  add_robot(spec, sim::testing::real_type({{"x", -1}, {"vx", 0.5}, {"first_s", 0.2}}));
  add_robot(spec, sim::testing::simulated_type(), {2, 0.1, 0});
  for (int i = 0; i < 5; ++i) add_twin(spec, {0.4 * i, 3, 0});
  sim::RobotType believes = sim::testing::simulated_type();
  believes.sensors.push_back(
      sim::testing::virtual_sensor<sim::testing::Beacon>("beacon", {{"offset_m", 0.1}}));
  believes.pose_from = 0;
  add_robot(spec, std::move(believes), {0, 5, 0});
  add_robot(spec, sim::testing::simulated_type(), {2, 5, 0});
  return spec;
}

TEST(RecordKeeper, KeepsWhereEachRobotWasAndWasToldToBe) {
  const auto engine = sim::testing::make_engine(crowd_with_a_late_robot());
  ASSERT_NE(engine, nullptr);
  const BodyKinds kinds(engine->spec(), std::vector<std::string>(engine->spec().robots.size()));
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) /
                                     fmt::format("rave_record_keeper_{}.mcap", ::getpid());
  auto keeper = RecordKeeper::open(file, *engine, kinds, info_of(*engine, kinds), {}, nullptr);
  ASSERT_TRUE(keeper) << keeper.error().text();
  constexpr int kSteps = 600;
  std::vector<std::vector<Place>> expected;
  std::size_t made_way = 0;
  std::size_t unseen = 0;
  for (int step = 0; step < kSteps; ++step) {
    ASSERT_TRUE(engine->step());
    (*keeper)->keep(*engine);
    expected.push_back(places_in(*engine));
    for (const Place& place : expected.back()) {
      unseen += place.reported ? 0U : 1U;
      made_way += place.truth && !same(place.truth, place.reported) ? 1U : 0U;
    }
  }
  ASSERT_TRUE((*keeper)->end(engine->hash().value()));
  EXPECT_GT(made_way, 0U) << "nobody had to, so this shows less than it should";
  EXPECT_GT(unseen, 0U) << "the recorded robot was seen at once";
  const auto reader = record::McapReader::open(file);
  ASSERT_TRUE(reader) << reader.error().text();
  std::size_t step = 0;
  const auto read = record::for_each_message(
      *reader, record::topic::kPoses, [&](const record::MessageView& message) -> Status {
        RAVE_TRY_ASSIGN(const auto poses, record::decode_poses(message.bytes));
        EXPECT_EQ(poses.step, step);
        const std::vector<Place>& places = expected.at(step++);
        std::vector<std::size_t> seen(places.size());
        for (const record::RobotPose& pose : poses.items) {
          const std::uint32_t r = pose.robot.value();
          ++seen.at(r);
          EXPECT_TRUE(same(pose.true_pose, places[r].truth)) << "robot " << r << ", step " << step;
          EXPECT_TRUE(same(pose.reported_pose, places[r].reported))
              << "robot " << r << ", step " << step;
        }
        EXPECT_EQ(std::ranges::count(seen, 1U), static_cast<std::ptrdiff_t>(places.size()))
            << "each robot once in step " << step;
        return ::testing::Test::HasFailure() ? fail(ErrorCode::kState, "differs") : Status();
      });
  EXPECT_TRUE(read) << read.error().text();
  EXPECT_EQ(step, expected.size());
  std::filesystem::remove(file);
}

/// Says where its robot is, and how sure that is: from 2.5 s on less so in each sample, until 4 s.
class Unsure final : public VirtualSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  Status configure(const VirtualSensorSetup& /*setup*/, VirtualDeclaration& /*what*/) override {
    return {};
  }
  void sample(const WorldView& /*world*/, const SampleItem& item) const override {
    const double time_s = static_cast<double>(item.header->stamp_ns) * 1e-9;
    const double variance_m2 = time_s < 2.5 ? 0.25 : time_s < 4 ? 0.1 * time_s : 0;
    auto* const reading = static_cast<PoseReading*>(item.records);
    *reading = {item.X_WR.x, item.X_WR.y, item.X_WR.yaw, variance_m2, 0};
    item.header->count = 1;
  }
};

TEST(RecordKeeper, KeepsVariancesAsTheyChangeAndOnceASecond) {
  using sim::testing::add_robot;
  sim::EngineSpec spec;
  add_robot(spec, sim::testing::simulated_type(), {0, 0, 0});
  sim::RobotType unsure = sim::testing::simulated_type();
  unsure.sensors.push_back(sim::testing::virtual_sensor<Unsure>("unsure"));
  unsure.pose_from = 0;
  add_robot(spec, std::move(unsure), {0, 5, 0});
  const auto engine = sim::testing::make_engine(std::move(spec));
  ASSERT_NE(engine, nullptr);
  const BodyKinds kinds(engine->spec(), std::vector<std::string>(2));
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) /
                                     fmt::format("rave_variances_{}.mcap", ::getpid());
  auto keeper = RecordKeeper::open(file, *engine, kinds, info_of(*engine, kinds), {}, nullptr);
  ASSERT_TRUE(keeper) << keeper.error().text();
  while (engine->time().seconds() < 8) {
    ASSERT_TRUE(engine->step());
    (*keeper)->keep(*engine);
  }
  ASSERT_TRUE((*keeper)->end(engine->hash().value()));
  const auto reader = record::McapReader::open(file);
  ASSERT_TRUE(reader) << reader.error().text();
  std::vector<record::StepOf<record::PoseVariance>> told;
  const auto take = [&](const record::MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(told.emplace_back(), record::decode_variances(message.bytes));
    return {};
  };
  ASSERT_TRUE(record::for_each_message(*reader, record::topic::kVariances, take));
  const auto between = [&](double from_s, double to_s) {
    return std::ranges::count_if(told, [&](const auto& message) {
      return message.time.seconds() >= from_s && message.time.seconds() < to_s;
    });
  };
  EXPECT_EQ(between(0, 2.4), 3) << "what stands is told at first and once a second";
  EXPECT_GE(between(2.6, 3.9), 12) << "what changes ten times a second";
  EXPECT_LE(between(2.6, 3.9), 14);
  EXPECT_EQ(between(4.3, 9), 0) << "nothing, once there are none";
  ASSERT_GE(told.size(), 2U);
  EXPECT_EQ(told.front().items, (std::vector<record::PoseVariance>{{RobotId(1), 0.25, 0}}));
  EXPECT_TRUE(told.back().items.empty()) << "the last one voids those before";
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace rave::runtime::testing
