// SPDX-License-Identifier: Apache-2.0
// A program of its own: it counts every allocation of the process.
#include "counted_allocations.hpp"
#include "engine_fixture.hpp"

namespace rave::sim::testing {
namespace {

/// Robots that see, decide and bump into one another, boxes and walls.
EngineSpec crowd() {
  EngineSpec spec;
  spec.threads = 2;
  spec.step = from_seconds(0.1);
  constexpr double kSide_m = 24;
  for (const double at_m : {-1.0, kSide_m}) {
    spec.world.obstacles.push_back(box({at_m, kSide_m / 2, 0}, 0.1, 30));
    spec.world.obstacles.push_back(box({kSide_m / 2, at_m, 0}, 30, 0.1));
  }
  for (int i = 0; i < 100; ++i) {
    spec.world.obstacles.push_back(
        box({0.6 + 2.4 * (i % 10), 0.6 + 2.4 * (i / 10), 0.1 * i}, 0.5, 0.4));
  }
  RobotType type = simulated_type();
  type.sensors.push_back(laser(16, 6, 0.2));
  type.program = program<Roam>();
  add_robot(spec, std::move(type));
  for (std::uint32_t r = 1; r < 400; ++r) {
    const std::uint32_t row = r / 20;
    add_twin(spec, {1.2 * (r % 20), 1.2 * row, 0.1 * (r % 60)});
  }
  return spec;
}

TEST(EngineStep, AllocatesNothingInTheSwing) {
  const auto engine = make_engine(crowd());
  for (int k = 0; k < 300; ++k) ASSERT_TRUE(engine->step());
  const std::uint64_t before = allocations.load();
  std::size_t contacts = 0;
  bool stepped = true;
  for (int k = 0; k < 300; ++k) {
    stepped = engine->step().has_value() && stepped;
    contacts += engine->events().size();
  }
  const std::uint64_t count = allocations.load() - before;
  ASSERT_TRUE(stepped);
  EXPECT_GT(contacts, 500U) << "the world is not as busy as it is meant to be";
  // A list may still grow a few times, when a step has more contacts than any before.
  EXPECT_LE(count, 8U);
}

}  // namespace
}  // namespace rave::sim::testing
