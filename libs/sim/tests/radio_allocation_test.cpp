// SPDX-License-Identifier: Apache-2.0
// A program of its own, since it counts what all of it allocates.
#include "counted_allocations.hpp"
#include "rave/sim_testing/radio_fixture.hpp"

namespace rave::sim::testing {
namespace {

/// What 100 steps allocate once the run is in its swing.
std::size_t allocated(bool talk) {
  EngineSpec spec;
  RobotType type = simulated_type();
  if (talk) {
    add_transmitter(type);
    add_communicator(type, {{"range_m", 5}, {"delay_s", 0.025}, {"rate", 4000}, {"queue", 400}});
    type.program = program<Beaconing>();
  } else {
    type.program = program<Drive>({{"v", 0}});
  }
  add_robot(spec, std::move(type));
  for (int r = 1; r < 200; ++r) {
    const int row = r / 15;
    add_twin(spec, {2.0 * (r % 15), 2.0 * row, 0});
  }
  const auto engine = make_engine(std::move(spec));
  for (int k = 0; k < 100; ++k) EXPECT_TRUE(engine->step());
  const std::size_t before = allocations;
  for (int k = 0; k < 100; ++k) EXPECT_TRUE(engine->step());
  const std::size_t count = allocations - before;
  EXPECT_TRUE(!talk || engine->radio_counts().delivered > 100'000);
  return count;
}

TEST(RadioAllocation, MessagesCostNoneInTheSwing) { EXPECT_EQ(allocated(true), allocated(false)); }

}  // namespace
}  // namespace rave::sim::testing
