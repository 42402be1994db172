// SPDX-License-Identifier: Apache-2.0
// Takes one sample at a known place, in a world where nothing is.
#include "@NAME@.hpp"

#include <cmath>
#include <string>

namespace {

class EmptyWorld final : public rave::WorldView {
 public:
  rave::SimTime time() const noexcept override { return {}; }
  std::uint32_t robot_count() const noexcept override { return 1; }
  rave::BodyId body_of(rave::RobotId) const noexcept override { return {}; }
  rave::Pose2 pose(rave::RobotId) const noexcept override { return {}; }
  rave::Twist2 velocity_W(rave::RobotId) const noexcept override { return {}; }
  rave::Layer layer_of(rave::BodyId) const noexcept override { return {}; }
  std::span<const rave::Landmark> landmarks() const noexcept override { return {}; }
  rave::RayHit cast(rave::Vec2, double, double, double, rave::LayerMask,
                    rave::BodyId) const noexcept override {
    return {};
  }
  bool visible(rave::Vec2, rave::Vec2, double, rave::LayerMask, rave::BodyId,
               rave::BodyId) const noexcept override {
    return true;
  }
  std::uint32_t robots_within(rave::Vec2, double,
                              std::span<rave::RobotId>) const noexcept override {
    return 0;
  }
  rave::TouchState touch(rave::RobotId) const noexcept override { return {}; }
};

// Empty if the sensor reads what it should.
std::string problem() {
  rave::ParamValue params[2];
  params[0].name = "x_m";
  params[0].number = 3;
  params[1].name = "y_m";
  params[1].number = 4;
  rave::VirtualSensorSetup setup;
  setup.params = params;
  setup.param_count = 2;
  @CLASS@ sensor;
  rave::VirtualDeclaration declaration;
  const rave::Status configured = sensor.configure(setup, declaration);
  if (!configured) return configured.error().text();

  rave::SampleHeader header;
  double value = 0;
  rave::SampleItem item;
  item.header = &header;
  item.records = &value;
  item.capacity = declaration.capacity;
  sensor.sample(EmptyWorld(), item);
  if (header.count != 1) return "there is no reading";
  if (std::abs(value - 5) > 1e-12) return "it reads " + std::to_string(value) + " m, not 5 m";
  return "";
}

}  // namespace

#if defined(WITH_GTEST)
#include <gtest/gtest.h>
TEST(@CLASS@, ReadsTheDistance) { EXPECT_EQ(problem(), ""); }
#else
#include <cstdio>
int main() {
  std::puts(problem().c_str());
  return problem().empty() ? 0 : 1;
}
#endif
