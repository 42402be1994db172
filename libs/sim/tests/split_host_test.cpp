// SPDX-License-Identifier: Apache-2.0
#include "split_drivers.hpp"
#include "split_run.hpp"

namespace rave::sim::testing {
namespace {

/// Counts how many of it there are.
class Counted final : public VirtualActuator {
 public:
  static int& alive() {
    static int count = 0;
    return count;
  }
  Counted() { ++alive(); }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  ~Counted() override { --alive(); }
  Status start(const DeviceSetup&) override { return {}; }
  Twist2 propose(const MotionInput& input) override { return {input.command.value[0], 0, 0}; }
};

TEST(SplitHost, HasNoInstancesForRobotsOfOtherHosts) {
  static constexpr VirtualActuatorOps kCounted = detail::virtual_actuator_ops<Counted>();
  EngineSpec spec;
  RobotType type = simulated_type();
  type.actuators[0].virtual_ops = &kCounted;
  add_robot(spec, std::move(type));
  for (std::uint32_t r = 1; r < 10; ++r) add_twin(spec, {double{1} * r, 0, 0});
  // Of a type without local robots not even the functions are needed.
  RobotType stranger = real_type({});
  stranger.sensors[0].hardware_ops = nullptr;
  stranger.actuators[0].hardware_ops = nullptr;
  stranger.controllers[0].ops = nullptr;
  stranger.transmitters.emplace_back();
  stranger.communicators.emplace_back().name = "air";
  add_robot(spec, std::move(stranger));
  spec.local = {RobotId(8), RobotId(3)};
  ASSERT_EQ(Counted::alive(), 0);
  {
    const auto host = make_engine(std::move(spec));
    ASSERT_NE(host, nullptr);
    EXPECT_EQ(Counted::alive(), 2);
    ASSERT_EQ(host->group_count(), 1U);
    ASSERT_EQ(host->members(0).size(), 2U);
    EXPECT_EQ(host->members(0)[0], RobotId(3));
    EXPECT_EQ(host->members(0)[1], RobotId(8));
    EXPECT_TRUE(host->is_local(RobotId(3)));
    EXPECT_FALSE(host->is_local(RobotId(4)));
    HostReport report;
    ASSERT_TRUE(host->propose(report));
  }
  EXPECT_EQ(Counted::alive(), 0);
}

}  // namespace
}  // namespace rave::sim::testing
