// SPDX-License-Identifier: Apache-2.0
// What a run with a recording keeps in memory for each step that it lasts. A program of its own: it
// follows every allocation of the process.
#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "rave/recording/record_keeper.hpp"
#include "rave/sim_testing/engine_fixture.hpp"

namespace {

/// In use now, by all threads.
std::atomic<std::int64_t> live_bytes{0};

}  // namespace

// Not inlined: the compiler would take malloc and delete for a pair that does not match.
// NOLINTBEGIN(misc-new-delete-overloads, misc-definitions-in-headers)
__attribute__((noinline)) void* operator new(std::size_t size) {
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  live_bytes += static_cast<std::int64_t>(::malloc_usable_size(memory));
  return memory;
}
// Buffers of std::stable_sort are taken with this one and given back with the ordinary delete.
__attribute__((noinline)) void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory != nullptr) live_bytes += static_cast<std::int64_t>(::malloc_usable_size(memory));
  return memory;
}
__attribute__((noinline)) void operator delete(void* memory) noexcept {
  live_bytes -= static_cast<std::int64_t>(::malloc_usable_size(memory));
  std::free(memory);
}
__attribute__((noinline)) void operator delete(void* memory, std::size_t) noexcept {
  operator delete(memory);
}
// NOLINTEND(misc-new-delete-overloads, misc-definitions-in-headers)

namespace rave::runtime::testing {
namespace {

using namespace sim::testing;

/// Robots that see, decide and are told where they are, with room enough that nobody meets anybody.
sim::EngineSpec walkers() {
  sim::EngineSpec spec;
  spec.world.obstacles.push_back(box({2, 0.5, 0.3}, 0.6, 0.4));
  sim::RobotType type = simulated_type();
  type.sensors.push_back(laser(16, 3, 3));
  type.program = program<sim::testing::Drive>({{"v", 0.5}, {"w", 1}});
  add_robot(spec, std::move(type));
  for (int i = 1; i < 20; ++i) add_twin(spec, {4.0 * i, 0, 0});
  add_robot(spec, real_type({{"y", 9}, {"vx", 0.1}}));
  return spec;
}

TEST(LongRun, KeepsNothingOfItsSteps) {
  const auto engine = make_engine(walkers());
  ASSERT_NE(engine, nullptr);
  const BodyKinds kinds(engine->spec(), std::vector<std::string>(engine->spec().robots.size()));
  const std::filesystem::path file = std::filesystem::path(::testing::TempDir()) /
                                     fmt::format("rave_long_run_{}.mcap", ::getpid());
  auto keeper = RecordKeeper::open(file, *engine, kinds, info_of(*engine, kinds), {}, nullptr);
  ASSERT_TRUE(keeper) << keeper.error().text();
  constexpr int kSteps = 4000;
  std::size_t events = 0;
  bool flushed = true;
  const auto window = [&] {
    for (int k = 0; k < kSteps; ++k) {
      EXPECT_TRUE(engine->step());
      (*keeper)->keep(*engine);
      events += engine->events().size();
      // How much waits for the disk is no matter of how long the run is.
      flushed = (k % 20 != 19 || (*keeper)->recorder().flush()) && flushed;
    }
    return live_bytes.load();
  };
  // Lists grow to their size first.
  window();
  const std::int64_t before = window();
  const std::int64_t after = window();
  EXPECT_TRUE(flushed);
  EXPECT_EQ(events, 0U) << "events are kept, and this is not about them";
  // A host of 25 MB that grows by 5 % in an hour of 100 steps a second.
  EXPECT_LE(after - before, 3.5 * kSteps) << before << " -> " << after;
  EXPECT_TRUE((*keeper)->end(engine->hash().value()));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace rave::runtime::testing
