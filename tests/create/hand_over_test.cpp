// SPDX-License-Identifier: Apache-2.0
// A Create changes between its simulated and its real drivers while the run goes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "rave/run_testing/create_run.hpp"
#include "rave/run_testing/recorded_run.hpp"

namespace rave::tests {
namespace {

using Json = nlohmann::json;

/// Two goals in a row and one that leads back: who begins anew turns round at once.
constexpr const char* kGoals =
    "program:\n"
    "  driver: go_to_goal\n"
    "  period_s: 0.1\n"
    "  params: {goals_m: [1.4, 1.05, 3.0, 1.1, 1.0, 0.8], cruise_mps: 0.2, tolerance_m: 0.15}\n";

struct Place {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
};

/// Where the robot of the only run is, as `rave ps` says.
std::optional<Place> place_of_rosie() {
  const std::string text = CreateRun::rave_says("ps --robots").text;
  std::size_t at = text.find("rosie");
  if (at == std::string::npos) return std::nullopt;
  at = text.find(" at (", at);
  if (at == std::string::npos) return std::nullopt;
  Place place;
  double yaw_deg = 0;
  if (std::sscanf(text.c_str() + at, " at (%lf, %lf) m, %lf", &place.x_m, &place.y_m, &yaw_deg) !=
      3) {
    return std::nullopt;
  }
  place.yaw_rad = yaw_deg * 3.14159265358979 / 180;
  return place;
}

template <class Wanted>
Place await_place(Wanted wanted) {
  std::optional<Place> now;
  const bool came = testing::await(
      [&] {
        now = place_of_rosie();
        return now && wanted(*now);
      },
      kAskRave);
  EXPECT_TRUE(came) << (now ? now->x_m : -1) << " " << (now ? now->y_m : -1);
  return now.value_or(Place{});
}

/// Waits until it is at one place in two looks.
Place await_standing() {
  std::optional<Place> before;
  return await_place([&](const Place& now) {
    const bool stands = before && std::hypot(now.x_m - before->x_m, now.y_m - before->y_m) < 1e-3;
    before = now;
    return stands;
  });
}

/// The only runs of the test's own folder of sockets.
class HandOver : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("create_hand_over_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    std::filesystem::permissions(folder_, std::filesystem::perms::owner_all);
    ::setenv("XDG_RUNTIME_DIR", folder_.c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("XDG_RUNTIME_DIR");
    std::filesystem::remove_all(folder_);
  }
  /// How far the robot jumped in a hand-over that was made.
  static double jump_m(const Json& hand_over) {
    const std::string what = hand_over["what"];
    double metres = 1e9;
    const std::size_t at = what.find("moved by ");
    if (at != std::string::npos) std::sscanf(what.c_str() + at, "moved by %lf", &metres);
    return metres;
  }
  std::filesystem::path folder_;
};

TEST_F(HandOver, ToTheRealRobotAndBackKeepsPlaceAndProgram) {
  CreateRun run("create-simulated", 600, {"--slip", "0.02,0.04"}, "", "", "create", "", kGoals);
  run.start();
  // Past the first goal, and then held where it is.
  await_place([](const Place& at) { return at.x_m > 1.9; });
  EXPECT_EQ(CreateRun::rave_says("stop --robot rosie").exit_code, 0);
  const Place stands = await_standing();
  run.peer->tell("place " + std::to_string(stands.x_m) + " " + std::to_string(stands.y_m) + " " +
                 std::to_string(stands.yaw_rad));
  const double path_before_m = run.state()["path_m"];
  const auto real = CreateRun::rave_says("hand-over rosie real");
  ASSERT_EQ(real.exit_code, 0) << real.text;
  EXPECT_NE(real.text.find("simulated -> real"), std::string::npos) << real.text;
  EXPECT_EQ(run.state()["path_m"], path_before_m) << "a stop holds whatever drives the robot";
  EXPECT_EQ(CreateRun::rave_says("arm --release --robot rosie").exit_code, 0);
  // On to the second goal, not back to the first one.
  const Json there = run.await_state([](const Json& s) {
    return std::hypot(s["x"].get<double>() - 3.0, s["y"].get<double>() - 1.1) < 0.25;
  });
  EXPECT_LT(there["path_m"].get<double>() - path_before_m, 1.4);
  run.await_state([](const Json& s) { return s["x"].get<double>() < 2.6; });

  const auto simulated = CreateRun::rave_says("hand-over rosie simulated");
  ASSERT_EQ(simulated.exit_code, 0) << simulated.text;
  const Json left = run.await_state(testing::wheels_stand);
  // The simulated robot ends the way alone.
  await_place([](const Place& at) { return std::hypot(at.x_m - 1, at.y_m - 0.8) < 0.3; });
  EXPECT_NEAR(run.state()["path_m"].get<double>(), left["path_m"].get<double>(), 1e-3);
  EXPECT_EQ(run.state()["mode"], "passive") << "it is left at rest";
  run.rave->interrupt();
  EXPECT_EQ(run.rave->wait(), 0);
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  ASSERT_EQ(result["hand_overs"].size(), 2U) << result["hand_overs"].dump();
  for (const Json& hand_over : result["hand_overs"]) {
    EXPECT_TRUE(hand_over["made"]) << hand_over.dump();
    EXPECT_LT(jump_m(hand_over), 0.02) << hand_over.dump();
  }
  EXPECT_EQ(result["events"]["program_failed"], 0);
  EXPECT_EQ(result["events"]["driver_failed"], 0) << result["problems"].dump();
}

/// Stands in a corner, on a host of its own, and sees real robots alone.
constexpr const char* kGuest =
    "  - name: guest\n"
    "    pose: {x_m: 3.7, y_m: 0.3, yaw_deg: 135}\n"
    "    robot:\n"
    "      body: {shapes: [{disc_radius_m: 0.1, z_m: [0, 0.3]}]}\n"
    "      sensors:\n"
    "        - name: laser\n"
    "          driver: virtual_laser\n"
    "          mount: {z_m: 0.05}\n"
    "          period_s: 0.1\n"
    "          senses: [real_robots]\n"
    "          params: {fov_deg: 180, rays: 361, range_max_m: 6}\n";

/// How many scans of the guest met something, and how many met nothing.
std::pair<int, int> scans_of_guest(const CreateRun& run) {
  const auto all = cli_test::readings_of(run.file("out/hosts/lab/run.mcap"));
  const auto scans = all.find("guest/laser");
  if (scans == all.end()) return {0, 0};
  std::pair<int, int> counts{0, 0};
  for (const cli_test::Reading& reading : scans->second) {
    const std::string& bytes = std::get<3>(reading);
    std::vector<float> ranges(bytes.size() / sizeof(float));
    std::memcpy(ranges.data(), bytes.data(), ranges.size() * sizeof(float));
    const bool met =
        std::any_of(ranges.begin(), ranges.end(), [](float range_m) { return range_m < 5.9F; });
    ++(met ? counts.first : counts.second);
  }
  return counts;
}

TEST_F(HandOver, OnAHostOfItsOwnIsSeenByTheOthers) {
  CreateRun run("create-simulated", 600, {}, kGuest,
                "hosts:\n  - {name: base, robots: [rosie]}\n  - {name: lab, robots: [guest]}\n",
                "create", "    shadow: true\n    hand_over: {within_m: 5, within_deg: 180}\n");
  run.start();
  const auto says = [](const std::string& words) {
    return testing::await_answer([&] { return Json(CreateRun::rave_says(words).text); },
                                 [](const Json&) { return true; });
  };
  testing::await_answer([&] { return says("ps"); },
                        [](const Json& text) {
                          const auto runs = text.get<std::string>();
                          return runs.find("create@base") != std::string::npos &&
                                 runs.find("starting or ending") == std::string::npos;
                        });
  const auto real = CreateRun::rave_says("hand-over rosie real");
  ASSERT_EQ(real.exit_code, 0) << real.text;
  EXPECT_NE(real.text.find("create@base"), std::string::npos) << real.text;
  EXPECT_NE(real.text.find("simulated -> real"), std::string::npos) << real.text;
  run.await_state([](const Json& s) { return s["path_m"].get<double>() > 0.3; });
  testing::await_answer([&] { return says("shadow --json"); },
                        [](const Json& text) {
                          return text.get<std::string>().find("\"running\": true") !=
                                 std::string::npos;
                        });
  const auto simulated = CreateRun::rave_says("hand-over rosie simulated");
  EXPECT_EQ(simulated.exit_code, 0) << simulated.text;
  run.rave->interrupt();
  EXPECT_EQ(run.rave->wait(), 0);
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  ASSERT_EQ(result["hand_overs"].size(), 2U) << result["hand_overs"].dump();
  for (const Json& hand_over : result["hand_overs"]) EXPECT_TRUE(hand_over["made"]);
  // The shadow is that of its host, as far as that one knew it.
  ASSERT_EQ(result["shadows"].size(), 1U) << result.dump();
  EXPECT_EQ(result["shadows"][0]["robot"], "rosie");
  EXPECT_EQ(result["shadows"][0]["starts"], 1);
  std::ifstream own(run.file("out/hosts/base/result.json"));
  EXPECT_EQ(result["shadows"], Json::parse(own, nullptr, false)["shadows"]);
  const auto [met, missed] = scans_of_guest(run);
  EXPECT_GT(met, 0) << "while it was real";
  EXPECT_GT(missed, 0) << "while it was simulated";
}

TEST_F(HandOver, ToARobotThatIsNotThereIsRefusedAndTheRunGoesOn) {
  CreateRun run("create-simulated", 600, {}, "", "", "create");
  run.peer->tell("vanish");
  run.start();
  await_place([](const Place&) { return true; });
  const auto real = CreateRun::rave_says("hand-over rosie real");
  EXPECT_EQ(real.exit_code, 1);
  EXPECT_NE(real.text.find("no robot with the Open Interface answered"), std::string::npos)
      << real.text;
  const Place before = await_place([](const Place&) { return true; });
  await_place([&](const Place& now) {
    return std::hypot(now.x_m - before.x_m, now.y_m - before.y_m) > 0.1;
  });
  // It comes back, but stands elsewhere: so does the answer.
  run.peer->tell("return");
  EXPECT_EQ(CreateRun::rave_says("stop --robot rosie").exit_code, 0);
  const Place stands = await_standing();
  run.peer->tell("place " + std::to_string(stands.x_m > 2 ? 0.5 : 3.5) + " 0.5 0");
  const auto far = CreateRun::rave_says("hand-over rosie real");
  EXPECT_EQ(far.exit_code, 1);
  EXPECT_NE(far.text.find("from its present pose"), std::string::npos) << far.text;
  run.rave->interrupt();
  EXPECT_EQ(run.rave->wait(), 0);
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  EXPECT_EQ(result["events"]["hand_over_refused"], 2) << result["events"].dump();
  EXPECT_EQ(result["robots"][0]["reality"], "simulated");
}

TEST_F(HandOver, ARobotThatVanishesAfterwardsIsALossAsAnyOther) {
  CreateRun run("create-simulated", 600, {}, "", "", "create",
                "    hand_over: {within_m: 5, within_deg: 180}\n");
  run.start();
  await_place([](const Place&) { return true; });
  const auto real = CreateRun::rave_says("hand-over rosie real");
  ASSERT_EQ(real.exit_code, 0) << real.text;
  run.await_state(testing::wheels_turn);
  run.peer->tell("vanish");
  run.await_state(testing::wheels_stand);
  // Nobody can see whether it stands, so the simulated one does not begin elsewhere.
  const auto simulated = CreateRun::rave_says("hand-over rosie simulated");
  EXPECT_EQ(simulated.exit_code, 1);
  EXPECT_NE(simulated.text.find("did not come to rest"), std::string::npos) << simulated.text;
  run.rave->interrupt();
  EXPECT_EQ(run.rave->wait(), 1);
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  EXPECT_EQ(result["events"]["driver_failed"], 3) << "odometry, bumper and wheels";
  EXPECT_EQ(result["robots"][0]["reality"], "real");
}

TEST_F(HandOver, BetweenSimulatedDriversIsTheSameRunAgain) {
  const auto hash_of = [](const std::string& threads) {
    CreateRun run("create-simulated", 12, {}, "",
                  "threads: " + threads +
                      "\npace: max\nchanges:\n"
                      "  - {at_s: 3, robot: rosie, hand_over: twin}\n"
                      "  - {at_s: 8, robot: rosie, hand_over: first}\n",
                  "create-simulated");
    run.start();
    EXPECT_EQ(run.rave->wait(), 0);
    const Json result = run.result();
    EXPECT_EQ(result["hand_overs"].size(), 2U);
    EXPECT_EQ(result["events"]["handed_over"], 2);
    EXPECT_EQ(CreateRun::rave_says("verify " + run.file("out")).exit_code, 0);
    return result["hash"].get<std::string>();
  };
  const std::string one = hash_of("1");
  EXPECT_EQ(one, hash_of("1"));
  EXPECT_EQ(one, hash_of("2"));
}

}  // namespace
}  // namespace rave::tests
