// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rave/run_testing/create_run.hpp"

namespace rave::tests {
namespace {

using Json = nlohmann::json;

TEST(CreateRun, TheRealRobotObeysItsProgramAndTouchesNothing) {
  CreateRun run("create", 8,
                {"--clock-start-s", "3", "--drift-ppm", "200", "--command-delay-ms", "20"});
  run.start();
  EXPECT_EQ(run.rave->wait(), 0);
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  EXPECT_TRUE(result["whole"]) << result["problems"].dump();
  const Json& robot = result["robots"][0];
  EXPECT_EQ(robot["reality"], "real");
  EXPECT_TRUE(robot["obeys"]);
  EXPECT_GT(robot["way_m"], 0.2);
  const Json& device = result["devices"][0];
  EXPECT_EQ(device["device"], "base");
  EXPECT_EQ(device["driver"], "create_oi");
  EXPECT_GT(device["frames"], 50);
  const Json truth = run.await_state(testing::wheels_stand);
  EXPECT_GT(truth["path_m"], 0.2);
  EXPECT_EQ(truth["touches"], 0);
  EXPECT_EQ(truth["mode"], "passive") << "it is left at rest";
  EXPECT_NEAR(robot["final_pose"]["x_m"].get<double>(), truth["x"].get<double>(), 0.15);
  EXPECT_NEAR(robot["final_pose"]["y_m"].get<double>(), truth["y"].get<double>(), 0.15);
}

TEST(CreateRun, TheSimulatedTwinIsDrivenByTheSameProgram) {
  CreateRun run("create-simulated", 20);
  run.start();
  EXPECT_EQ(run.rave->wait(), 0);
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  EXPECT_EQ(result["robots"][0]["reality"], "simulated");
  EXPECT_EQ(result["robots"][0]["program"], "wander");
  EXPECT_GT(result["robots"][0]["way_m"], 1);
  EXPECT_EQ(result["events"]["contact"], 0);
}

TEST(CreateRun, AKilledDriverStopsTheRobotWithin300Milliseconds) {
  for (int times = 0; times < 3; ++times) {
    CreateRun run("create", 600);
    run.start();
    run.await_state(testing::wheels_turn);
    run.rave->kill();
    const Json now = run.await_state(testing::wheels_stand);
    EXPECT_EQ(now["mode"], "safe") << "nobody told it to stop";
    EXPECT_GE(now["watchdog_stops"], 1);
    // From the last drive command to standstill, by the robot's own clock.
    EXPECT_LE(now["watchdog_still_ms"], 300);
    EXPECT_GT(now["watchdog_still_ms"], 150);
  }
}

TEST(CreateRun, ARobotThatVanishesAndReturnsDrivesOn) {
  CreateRun run("create", 600);
  run.start();
  run.await_state(testing::wheels_turn);
  run.peer->tell("vanish");
  run.await_state(testing::wheels_stand);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // it is away for longer than 1 s
  run.peer->tell("return");
  run.await_state(testing::wheels_turn);
  run.rave->interrupt();
  EXPECT_EQ(run.rave->wait(), 1) << "a loss is a problem of the run";
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  // Odometry, bumper and wheels.
  EXPECT_EQ(result["events"]["driver_failed"], 3);
  EXPECT_EQ(result["events"]["driver_back"], 3);
  EXPECT_EQ(result["devices"][0]["connects"], 2);
}

TEST(CreateRun, ALaserThatFallsSilentStopsTheRobotUntilItSpeaksAgain) {
  CreateRun run("create", 600);
  run.start();
  run.await_state(testing::wheels_turn);
  run.peer->tell("laser mute");
  run.await_console("sensor lost: ", 1);  // or, seen late, that its driver has failed
  const Json stopped = run.await_state(testing::wheels_stand);
  run.await_console("sensor `laser`: the laser at", 1);  // it has been away for 2 s
  EXPECT_EQ(run.state()["path_m"], stopped["path_m"]);
  run.peer->tell("laser speak");
  run.await_state(testing::wheels_turn);
  run.rave->interrupt();
  (void)run.rave->wait();
}

TEST(CreateRun, ALaserThatRepeatsItselfStopsTheRobotUntilItLooksAgain) {
  CreateRun run("create", 600);
  run.start();
  run.await_state(testing::wheels_turn);
  run.peer->tell("laser freeze");
  run.await_console("frozen: `laser` repeats the same scan", 1);
  run.await_state(testing::wheels_stand);
  run.peer->tell("laser see");
  run.await_state(testing::wheels_turn);
  run.rave->interrupt();
  (void)run.rave->wait();
}

TEST(CreateRun, ALaserThatMeasuresNothingStopsTheRobot) {
  CreateRun run("create", 600);
  run.start();
  run.await_state(testing::wheels_turn);
  run.peer->tell("laser blind 0");
  run.await_console("sensor lost: `laser`", 1);
  run.await_state(testing::wheels_stand);
  run.peer->tell("laser see");
  run.await_state(testing::wheels_turn);
  run.rave->interrupt();
  (void)run.rave->wait();
}

TEST(CreateRun, WhoIsBlindAheadTurnsAndTouchesNothing) {
  CreateRun run("create", 600);
  run.start();
  run.await_state(testing::wheels_turn);
  run.peer->tell("laser blind 7 -60 60");
  // It turns on the spot, again and again.
  const Json begun = run.await_state([](const Json& now) {
    return now["left_mps"].get<double>() * now["right_mps"].get<double>() < 0;
  });
  const Json turned = run.await_state([&](const Json& now) {
    return std::abs(now["yaw"].get<double>() - begun["yaw"].get<double>()) > 1.5;
  });
  EXPECT_LT(turned["path_m"].get<double>() - begun["path_m"].get<double>(), 0.05);
  EXPECT_EQ(turned["touches"], 0);
  run.rave->interrupt();
  (void)run.rave->wait();
}

TEST(CreateRun, ARobotThatIsNotThereIsAnErrorOfTheStart) {
  CreateRun run("create", 5);
  run.peer->tell("vanish");
  run.start();
  EXPECT_EQ(run.rave->wait(), 2);
}

}  // namespace
}  // namespace rave::tests
