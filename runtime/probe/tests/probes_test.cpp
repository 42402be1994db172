// SPDX-License-Identifier: Apache-2.0
#include "rave/probe/probes.hpp"

#include "rave/assemble_testing/host_fixture.hpp"
#include "rave/probe/probe_block.hpp"

namespace rave::probe {
namespace {

using runtime::testing::kBody;
using runtime::testing::kWheels;
using runtime::testing::scenario_text;

constexpr std::uint32_t kFirst = kProbeBit | 7;
const std::string kLaser = "{name: probe, driver: virtual_laser, params: {rays: 3, fov_deg: 180}}";

class ProbesTest : public ::testing::Test {
 protected:
  void SetUp() override { engine_ = new_engine(); }
  std::unique_ptr<sim::Engine> new_engine() {
    const std::string robots =
        fmt::format("  - {{name: a, pose: {{x_m: 0, y_m: 0}}, robot: {{{}, {}}}}}\n", kBody,
                    kWheels) +
        fmt::format("  - {{name: b, pose: {{x_m: 0, y_m: 3}}, robot: {{{}, {}}}}}\n", kBody,
                    kWheels);
    auto engine = host_.engine_of(scenario_text(
        robots, "obstacles: [{name: post, disc_radius_m: 0.5, x_m: 2, y_m: 0, z_m: [0, 1]}]\n"));
    if (engine) step(*engine);
    return engine;
  }
  static void step(sim::Engine& engine) { ASSERT_TRUE(engine.step().has_value()); }
  Probes probes_of(std::vector<Asked> asked) {
    Probes probes;
    probes.ask(*engine_, host_.catalogue(), asked);
    probes.sample(*engine_);
    return probes;
  }
  std::string refusal(const std::string& block) {
    const auto spec = read_block(block, host_.catalogue());
    return spec ? std::string("none") : spec.error().message;
  }
  static float range(const sim::LoneSensor& sensor, std::size_t i) {
    return static_cast<const float*>(sensor.records())[i];
  }

  runtime::testing::Host host_;
  std::unique_ptr<sim::Engine> engine_;
};

TEST_F(ProbesTest, ALaserThatNoRobotFileHasSeesTheWorldOfTheRun) {
  const Probes probes = probes_of({{0, kFirst, kLaser}});
  const sim::LoneSensor& laser = *probes.all().at({0, kFirst});
  EXPECT_EQ(laser.info().kind, ReadingKind::kRanges);
  ASSERT_EQ(laser.header().count, 3U);
  EXPECT_NEAR(range(laser, 1), 1.5, 1e-4) << "the post, ahead";
  EXPECT_NEAR(range(laser, 2), 2.85, 1e-4) << "the other robot, to the left";
  EXPECT_TRUE(std::isinf(range(laser, 0))) << "itself it does not see";
}

TEST_F(ProbesTest, LayersPlaceAndDirectionAreThoseOfTheBlock) {
  const Probes probes = probes_of(
      {{0, kFirst,
        "{name: p, driver: virtual_laser, senses: [simulated_robots], params: {rays: 3, fov_deg: "
        "180}}"},
       {0, kFirst + 1,
        "{name: p, driver: virtual_laser, mount: {x_m: 0.5, yaw_deg: 90}, params: {rays: 3, "
        "fov_deg: 180}}"}});
  EXPECT_TRUE(std::isinf(range(*probes.all().at({0, kFirst}), 1))) << "the post is no robot";
  EXPECT_NEAR(range(*probes.all().at({0, kFirst + 1}), 0), 1.0, 1e-4) << "half a metre nearer";
}

TEST_F(ProbesTest, EachVirtualSensorThatIsShippedCanBeTried) {
  for (const char* const driver : {"virtual_laser", "virtual_sonar", "virtual_infrared",
                                   "virtual_contact", "virtual_landmark_camera", "virtual_odometry",
                                   "indoor_positioning", "neighbour_velocity"}) {
    Probes probes = probes_of({{1, kFirst, fmt::format("{{name: p, driver: {}}}", driver)}});
    ASSERT_NE(probes.all().at({1, kFirst}), nullptr) << driver;
    step(*engine_);
    probes.sample(*engine_);
    EXPECT_EQ(probes.all().at({1, kFirst})->header().sequence, 2U) << driver;
  }
}

TEST_F(ProbesTest, TheRunIsTheSameWithAndWithout) {
  const auto alone = new_engine();
  Probes probes;
  for (int i = 0; i < 50; ++i) {
    step(*alone);
    step(*engine_);
    probes.ask(*engine_, host_.catalogue(),
               std::vector<Asked>{{0, kFirst, kLaser},
                                  {1, kFirst + 1, "{name: p, driver: indoor_positioning}"}});
    probes.sample(*engine_);
  }
  EXPECT_EQ(engine_->hash(), alone->hash());
}

TEST_F(ProbesTest, WhatNobodyAsksForAnyMoreEndsAndThereIsRoomForSixteen) {
  std::vector<Asked> asked;
  for (std::uint32_t i = 0; i < Probes::kMost + 3; ++i) asked.push_back({0, kFirst + i, kLaser});
  Probes probes;
  probes.ask(*engine_, host_.catalogue(), asked);
  EXPECT_EQ(probes.all().size(), Probes::kMost);
  asked.resize(1);
  probes.ask(*engine_, host_.catalogue(), asked);
  EXPECT_EQ(probes.all().size(), 1U);
  probes.ask(*engine_, host_.catalogue(), {});
  EXPECT_TRUE(probes.empty());
}

TEST_F(ProbesTest, WhatIsNoProbeIsLeftOut) {
  const Probes probes = probes_of({{0, 3, kLaser}, {9, kFirst, kLaser}});
  EXPECT_TRUE(probes.empty());
  const Probes broken = probes_of({{0, kFirst, "{name: p, driver: no_such_driver}"}});
  EXPECT_EQ(broken.all().at({0, kFirst}), nullptr);
}

TEST_F(ProbesTest, BadBlocksAreRefusedWithWhatWasExpected) {
  EXPECT_NE(refusal("{name: p, driver: virtual_lazer}").find("virtual_laser"), std::string::npos);
  EXPECT_NE(refusal("{name: p, driver: velocity}").find("velocity"), std::string::npos);
  EXPECT_NE(refusal("[1").find("YAML syntax"), std::string::npos);
  EXPECT_NE(refusal("{name: p, driver: virtual_laser, device: base}").find("unknown key `device`"),
            std::string::npos);
  EXPECT_NE(refusal("{name: p, driver: virtual_laser, mount: {x_m: 1e9}}").find("-100 to 100"),
            std::string::npos);
  EXPECT_NE(refusal("{name: p, driver: virtual_laser, params: {rays: 0}}").find("rays"),
            std::string::npos);
  EXPECT_NE(refusal("{name: p, driver: virtual_laser, senses: [ghosts]}").find("mapped_real"),
            std::string::npos);
  EXPECT_NE(refusal(std::string(3000, 'a')).find("more than 2048"), std::string::npos);
  auto many =
      read_block("{name: p, driver: virtual_laser, params: {rays: 100000}}", host_.catalogue());
  ASSERT_TRUE(many.has_value());
  const auto sensor = sim::LoneSensor::make(*std::move(many), 0.01);
  ASSERT_FALSE(sensor.has_value());
  EXPECT_NE(sensor.error().message.find("rays; expected at most 4096 of 16384"), std::string::npos);
}

}  // namespace
}  // namespace rave::probe
