// SPDX-License-Identifier: Apache-2.0
#include "rave/assemble_testing/host_fixture.hpp"
#include "rave/results/capture_watch.hpp"
#include "rave/results/encounters.hpp"
#include "rave/results/hit_counter.hpp"
#include "rave/results/sighting_check.hpp"
#include "rave/results/track_recorder.hpp"
#include "rave/world/touching.hpp"

namespace rave::runtime::testing {
namespace {

std::string standing(const std::string& name, double x_m, double y_m,
                     const std::string& more = {}) {
  return fmt::format("  - {{name: {}, pose: {{x_m: {}, y_m: {}}}, robot: {{{}, {}{}}}}}\n", name,
                     x_m, y_m, kBody, kWheels, more);
}

/// Five rays ahead over 4 degrees, 3 m, every 0.1 s.
std::string laser(const std::string& more = {}) {
  return ", sensors: [{name: laser, driver: virtual_laser, period_s: 0.1, mount: {z_m: 0.1}, "
         "params: {rays: 5, fov_deg: 4, range_max_m: 3}" +
         more + "}]";
}

/// The five recorded robots among what `world` says, for two minutes.
std::string recorded(const std::string& world, double step_s = 0.01) {
  std::string text =
      fmt::format("name: recorded\nduration_s: 120\nstep_s: {}\nhistory_s: 1\n{}", step_s, world) +
      "robots:\n";
  const int codes[] = {5, 14, 41, 32, 23};
  for (int robot = 1; robot <= 5; ++robot) {
    text += fmt::format(
        "  - {{name: real-{}, file: ../robots/recorded-create.yaml, variables: {{robot: {}, "
        "barcode: {}}}}}\n",
        robot, robot, codes[robot - 1]);
  }
  return text;
}

TEST(Encounters, KeepsTheClosestOfEachKindOfPair) {
  Host host;
  const auto engine = host.engine_of(scenario_text(
      standing("a", 0, 0) + standing("b", 1, 0) + standing("c", 1, 0.5) + standing("far", 50, 0),
      "obstacles: [{name: crate, box_m: [1, 1], x_m: -1.2, y_m: 0, z_m: [0, 1]}, {name: high, "
      "box_m: [1, 1], x_m: 1, y_m: -0.7, z_m: [1, 2]}]\n"));
  const BodyKinds kinds(engine->spec(), host.kinds());
  Encounters encounters(kinds, engine->spec());
  EXPECT_EQ(encounters.headline(), "");
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(engine->step().has_value());
    encounters.after_step(*engine);
  }
  // What hangs above the robots is no encounter.
  const auto closest = encounters.closest();
  ASSERT_EQ(closest.size(), 2U);
  const Encounter& robots = closest.at("simulated-simulated");
  EXPECT_NEAR(robots.gap_m, 0.2, 1e-9);
  EXPECT_NEAR(robots.centres_m, 0.5, 1e-9);
  EXPECT_EQ(robots.time_s, 0);
  EXPECT_EQ(kinds.name(robots.a), "b");
  EXPECT_EQ(kinds.name(robots.b), "c");
  EXPECT_NEAR(closest.at("simulated-virtual_obstacle").gap_m, 0.55, 1e-9);
  EXPECT_EQ(encounters.headline(), "closest simulated-simulated 0.20 m");
}

/// The least gap of all pairs of robots, or of robots and obstacles, by trying each pair.
double least_gap_m(const sim::Engine& engine, bool among_robots) {
  const world::Snapshot& world = engine.snapshot();
  const world::WorldModel& model = world.model();
  const auto obstacles = static_cast<std::uint32_t>(model.obstacles.size());
  const auto robots = static_cast<std::uint32_t>(model.robots.size());
  const std::uint32_t begin = among_robots ? obstacles : 0;
  const std::uint32_t end = among_robots ? obstacles + robots : obstacles;
  double least_m = 10;
  for (std::uint32_t robot = 0; robot < robots; ++robot) {
    for (std::uint32_t body = begin; body < end; ++body) {
      if (body == obstacles + robot) continue;
      const Pose2 X_WB =
          among_robots ? world.pose(RobotId(body - obstacles)) : world.obstacle_pose(BodyId(body));
      const double gap_m =
          world::separation(model.robots[robot], world.pose(RobotId(robot)), model.body(body), X_WB)
              .distance_m;
      least_m = std::min(least_m, gap_m);
    }
  }
  return least_m;
}

TEST(Encounters, MissesNobodyWhoComesNearerStill) {
  Host host;
  std::string robots;
  for (int robot = 0; robot < 5; ++robot) {
    robots += standing(fmt::format("r{}", robot), robot, 0.7 * (robot % 2),
                       ", program: {driver: wander, period_s: 0.05}" + laser());
  }
  const auto engine = host.engine_of(scenario_text(
      robots, "obstacles: [{name: crate, box_m: [1, 1], x_m: 2, y_m: 2, z_m: [0, 1]}]\n"));
  ASSERT_NE(engine, nullptr);
  const BodyKinds kinds(engine->spec(), host.kinds());
  Encounters encounters(kinds, engine->spec());
  double among_robots_m = 10;
  double to_obstacles_m = 10;
  int nearer = 0;
  for (int k = 0; k < 600; ++k) {
    ASSERT_TRUE(engine->step().has_value());
    encounters.after_step(*engine);
    const double gap_m = least_gap_m(*engine, true);
    if (gap_m < among_robots_m) ++nearer;
    among_robots_m = std::min(among_robots_m, gap_m);
    to_obstacles_m = std::min(to_obstacles_m, least_gap_m(*engine, false));
    const auto closest = encounters.closest();
    ASSERT_NEAR(closest.at("simulated-simulated").gap_m, among_robots_m, 1e-12) << k;
    if (to_obstacles_m >= 1) continue;  // it has come within reach
    ASSERT_NEAR(closest.at("simulated-virtual_obstacle").gap_m, to_obstacles_m, 1e-12) << k;
  }
  EXPECT_GT(nearer, 3) << "nobody moved";
}

TEST(CaptureWatch, ACaptureWhereAPoseWasLostIsSaidToBeOneAndDoesNotCount) {
  config::CaptureCheckFile check;
  check.before_s = 10;
  const Duration step = from_seconds(0.01);
  const Capture capture{RobotId(0), RobotId(1), 2.0, 0.1};
  const CaptureFacts facts{{capture}, 0.1};
  const auto pose = [](std::uint64_t at, sim::EventKind kind) {
    return sim::Event{at, RobotId(1), kind, BodyId(), "", 0};
  };
  std::vector<sim::Event> events;
  EXPECT_TRUE(holds(check, facts, events, step));
  events = {pose(200, sim::EventKind::kPoseStale)};
  EXPECT_EQ(lost_poses(capture, events, step), std::vector({RobotId(1)}));
  EXPECT_FALSE(holds(check, facts, events, step));
  events = {pose(100, sim::EventKind::kPoseStale), pose(150, sim::EventKind::kPoseBack),
            pose(201, sim::EventKind::kPoseStale)};
  EXPECT_TRUE(lost_poses(capture, events, step).empty()) << "back before it, lost behind it";
  EXPECT_TRUE(holds(check, facts, events, step));
  // A later one in time, with poses, counts.
  events = {pose(200, sim::EventKind::kPoseStale), pose(250, sim::EventKind::kPoseBack)};
  EXPECT_TRUE(holds(check, {{capture, {RobotId(0), RobotId(1), 3.0, 0.1}}, 0.1}, events, step));
}

TEST(TrackRecorder, OfLateStepsKeepsOnePointInTenAndTheWholeWay) {
  const auto record = [](bool late) {
    Host host;
    const auto engine = host.engine_of(scenario_text(
        standing("a", 0, 0, ", program: {driver: wander, period_s: 0.05}" + laser())));
    EXPECT_NE(engine, nullptr);
    const BodyKinds kinds(engine->spec(), host.kinds());
    TrackRecorder recorder(kinds, engine->spec(), {.duration_s = 4, .odometry_sensor = {}});
    const std::vector<sim::Event> none;
    for (int k = 0; k < 400; ++k) {
      EXPECT_TRUE(engine->step().has_value());
      recorder.after_step({*engine, none, late});
    }
    return std::pair(recorder.facts().at(0).track.points.size(), recorder.way_m().at(0));
  };
  const auto [all, way_m] = record(false);
  const auto [few, same_m] = record(true);
  ASSERT_GT(all, 20U);
  EXPECT_EQ(few, (all + 9) / 10);
  EXPECT_GT(way_m, 0.1);
  EXPECT_EQ(same_m, way_m);
}

TEST(HitCounter, CountsEachScanOnceByWhatItMet) {
  for (const char* const more : {"", ", latency_s: 0.13"}) {
    Host host;
    const auto engine = host.engine_of(
        scenario_text(standing("a", 0, 0, laser(more)) + standing("b", 1, 0, laser(more)),
                      "obstacles: [{name: wall, box_m: [1, 9], x_m: 3.5, y_m: 0, z_m: [0, 1]}]\n"));
    const BodyKinds kinds(engine->spec(), host.kinds());
    HitCounter hits(kinds);
    for (int k = 0; k < 21; ++k) {
      ASSERT_TRUE(engine->step().has_value());
      hits.after_step(*engine);
    }
    // Scans in steps 0, 10 and 20, five rays each: a sees b, b sees the wall.
    const auto counts = hits.counts();
    ASSERT_EQ(counts.size(), 1U) << more;
    EXPECT_EQ(counts.at("simulated").size(), 2U);
    EXPECT_EQ(counts.at("simulated").at("simulated"), 15U) << more;
    EXPECT_EQ(counts.at("simulated").at("virtual_obstacle"), 15U) << more;
  }
}

TEST(SightingCheck, ConfirmsARecordedCameraAndFailsWithTightLimits) {
  for (const bool generous : {true, false}) {
    Host host;
    const auto engine = host.engine_of(recorded("world: ../worlds/utias.yaml\n"));
    ASSERT_NE(engine, nullptr);
    config::SightingsCheckFile file;
    file.real.value = "camera";
    file.twin.value = "camera_twin";
    if (!generous) file.range_m = 0.001;
    SightingCheck check(file, engine->spec());
    EXPECT_FALSE(holds(file, check.facts().all())) << "nothing was seen yet";
    for (int k = 0; k < 12000; ++k) {
      ASSERT_TRUE(engine->step().has_value());
      check.after_step(*engine);
    }
    const SightingTally all = check.facts().all();
    EXPECT_GT(all.total, 500U);
    EXPECT_EQ(check.facts().by_robot.size(), 5U);
    EXPECT_EQ(holds(file, all), generous) << all.within_pct();
  }
}

/// Between two poses the robot was where a line between them says, in long steps and in short ones.
TEST(SightingCheck, TheStepOfTheRunIsNoPartOfTheResult) {
  std::vector<SightingTally> tallies;
  for (const double step_s : {0.002, 0.01, 0.1}) {
    Host host;
    const auto engine = host.engine_of(recorded("world: ../worlds/utias.yaml\n", step_s));
    ASSERT_NE(engine, nullptr);
    config::SightingsCheckFile file;
    file.real.value = "camera";
    file.twin.value = "camera_twin";
    // About half agree, so that a millimetre or a tenth of a degree changes the count.
    file.range_m = 0.05;
    file.bearing_deg = 0.5;
    SightingCheck check(file, engine->spec());
    // What comes in the last moments waits for a newer pose for as long as the step is.
    while (engine->time().seconds() < 20) {
      ASSERT_TRUE(engine->step().has_value());
      check.after_step(*engine);
    }
    tallies.push_back(check.facts().all());
  }
  EXPECT_GT(tallies[0].total, 300U);
  EXPECT_GT(tallies[0].within, tallies[0].total / 10);
  EXPECT_LT(tallies[0].within, tallies[0].total * 9 / 10);
  for (const SightingTally& tally : tallies) {
    EXPECT_EQ(tally.total, tallies[0].total);
    EXPECT_EQ(tally.within, tallies[0].within);
  }
}

TEST(SightingCheck, OfFewerSightingsThanItShouldCompareItFails) {
  config::SightingsCheckFile limits;
  EXPECT_FALSE(holds(limits, {}));
  EXPECT_FALSE(holds(limits, {99, 99, 0}));
  EXPECT_TRUE(holds(limits, {100, 100, 0}));
  limits.min_compared = 99;
  EXPECT_TRUE(holds(limits, {99, 99, 0}));
}

TEST(SightingCheck, UnknownCodesBeyondAFewAreMisses) {
  config::SightingsCheckFile limits;
  EXPECT_TRUE(holds(limits, {1000, 995, 10}));
  EXPECT_EQ(counted(limits, {1000, 995, 10}), 1000U);
  EXPECT_TRUE(holds(limits, {1000, 995, 15}));
  EXPECT_FALSE(holds(limits, {1000, 995, 16}));
  EXPECT_EQ(counted(limits, {1000, 995, 16}), 1006U);
  limits.max_unknown = 0;
  EXPECT_NEAR(within_pct(limits, {300, 300, 100}), 75, 1e-9);
}

TEST(SightingCheck, CountsCodesThatTheWorldDoesNotKnow) {
  Host host;
  const auto engine = host.engine_of(recorded(""));
  config::SightingsCheckFile file;
  file.real.value = "camera";
  file.twin.value = "camera_twin";
  SightingCheck check(file, engine->spec());
  for (int k = 0; k < 12000; ++k) {
    ASSERT_TRUE(engine->step().has_value());
    check.after_step(*engine);
  }
  // Without the tubes only the robots themselves are known.
  EXPECT_GT(check.facts().all().unknown, 500U);
  EXPECT_GT(check.facts().all().within_pct(), 99) << "of the robots that it knows";
  EXPECT_FALSE(holds(file, check.facts().all())) << "most of what was seen is not in the world";
  std::uint64_t sum = 0;
  for (const auto& [code, count] : check.facts().unknown_codes) sum += count;
  EXPECT_EQ(sum, check.facts().all().unknown);
  for (const int robot_code : {5, 14, 41, 32, 23}) {
    EXPECT_FALSE(check.facts().unknown_codes.contains(robot_code));
  }
}

}  // namespace
}  // namespace rave::runtime::testing
