// SPDX-License-Identifier: Apache-2.0
// The simulated twin of a real Create runs beside it.
#include <gtest/gtest.h>

#include <cmath>

#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_messages.hpp"
#include "rave/record/run_reader.hpp"
#include "rave/run_testing/create_run.hpp"

namespace rave::tests {
namespace {

using Json = nlohmann::json;

/// Stands in a corner and sees all robots, but no walls.
constexpr const char* kWatch =
    "  - name: watch\n"
    "    pose: {x_m: 3.7, y_m: 0.3, yaw_deg: 135}\n"
    "    robot:\n"
    "      body: {shapes: [{disc_radius_m: 0.1, z_m: [0, 0.3]}]}\n"
    "      sensors:\n"
    "        - name: laser\n"
    "          driver: virtual_laser\n"
    "          mount: {z_m: 0.05}\n"
    "          period_s: 0.1\n"
    "          senses: [real_robots, simulated_robots]\n"
    "          params: {fov_deg: 180, rays: 361, range_max_m: 6}\n";

/// A drive beside a shadow: what came of it.
struct Drive {
  Json result;
  std::size_t recorded = 0;
  double last_m = 0;
};

Drive drive(const std::string& slip) {
  CreateRun run("create", 20, {"--slip", slip}, kWatch, "", "create-simulated",
                "    shadow: true\n");
  run.start();
  EXPECT_EQ(run.rave->wait(), 0);
  Drive drive;
  drive.result = run.result();
  const auto reader = record::McapReader::open(run.file("out/run.mcap"));
  EXPECT_TRUE(reader.has_value());
  if (!reader) return drive;
  const auto take = [&](const record::MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(const auto step, record::decode_shadow(message.bytes));
    for (const record::ShadowRecord& shadow : step.items) {
      ++drive.recorded;
      drive.last_m = shadow.m;
    }
    return {};
  };
  EXPECT_TRUE(record::for_each_message(*reader, record::topic::kShadows, take));
  return drive;
}

TEST(Shadow, DriftsFromTheRobotAsItsWheelsSlip) {
  const Drive firm = drive("0,0");
  const Drive slipping = drive("0.02,0.12");
  for (const Drive* const one : {&firm, &slipping}) {
    ASSERT_TRUE(one->result.is_object());
    EXPECT_TRUE(one->result["whole"]) << one->result["problems"].dump();
    ASSERT_EQ(one->result["shadows"].size(), 1U);
    const Json& shadow = one->result["shadows"][0];
    EXPECT_GT(shadow["compared"], 0);
    EXPECT_EQ(shadow["robot"], "rosie");
    EXPECT_EQ(shadow["starts"], 1);
    EXPECT_GT(shadow["moments"].size(), 10U);
    EXPECT_TRUE(shadow["readings"].contains("laser")) << shadow.dump();
    EXPECT_TRUE(shadow["readings"].contains("odometry")) << shadow.dump();
    EXPECT_GT(one->recorded, 100U);
    EXPECT_NEAR(one->last_m, shadow["last"]["m"].get<double>(), 1e-5);
    // Nobody sees it: the only simulated robot is the one that watches.
    const Json& seen = one->result["hits"]["simulated"];
    EXPECT_TRUE(seen.contains("real")) << seen.dump();
    EXPECT_FALSE(seen.contains("simulated")) << seen.dump();
    EXPECT_FALSE(one->result["closest"].contains("simulated-simulated"));
  }
  const Json& near = firm.result["shadows"][0]["most"];
  const Json& far = slipping.result["shadows"][0]["most"];
  EXPECT_LT(near["m"].get<double>(), 0.25) << near.dump();
  EXPECT_GT(far["m"].get<double>(), 0.35) << far.dump();
  EXPECT_GT(far["m"].get<double>(), 2 * near["m"].get<double>());
  EXPECT_GT(far["rad"].get<double>(), near["rad"].get<double>());
}

TEST(Shadow, IsALiveNumberThatCanBeginAnew) {
  CreateRun run("create", 600, {"--slip", "0.02,0.12"}, "", "", "create-simulated",
                "    shadow: true\n");
  run.start();
  // Null as long as the run does not answer.
  const auto shadow = [&]() -> Json {
    const auto said = CreateRun::rave_says("shadow " + run.run_name() + " --json");
    const Json all = Json::parse(said.text, nullptr, false);
    return all.is_array() && all.size() == 1 ? all[0] : Json();
  };
  const auto await_shadow = [&](auto wanted) {
    return testing::await_answer(
        shadow, [&](const Json& s) { return s.is_object() && wanted(s); }, kAskRave);
  };
  const Json grown = await_shadow([](const Json& s) { return s["m"].get<double>() > 0.2; });
  EXPECT_TRUE(grown["running"]);
  const auto reset = CreateRun::rave_says("shadow " + run.run_name() + " --reset");
  EXPECT_EQ(reset.exit_code, 0) << reset.text;
  const Json anew =
      await_shadow([&](const Json& s) { return s["since_s"].get<double>() > grown["since_s"]; });
  EXPECT_LT(anew["m"].get<double>(), 0.15);
  EXPECT_EQ(CreateRun::rave_says("shadow " + run.run_name() + " --reset --robot rosy").exit_code,
            1);
  run.rave->interrupt();
  EXPECT_EQ(run.rave->wait(), 0);
  const Json result = run.result();
  ASSERT_TRUE(result.is_object());
  EXPECT_EQ(result["shadows"][0]["starts"], 2);
  EXPECT_EQ(result["events"]["shadow_reset"], 1);
}

}  // namespace
}  // namespace rave::tests
