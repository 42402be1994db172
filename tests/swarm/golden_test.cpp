// SPDX-License-Identifier: Apache-2.0
// The workloads of `rave bench swarm` give the same hash for any number of threads, on any
// processor and in any type of build. ctest runs the first test once more with the C library's
// processor features hidden.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <filesystem>

#include "rave/assemble/build.hpp"
#include "rave/sim/engine.hpp"
#include "rave/swarm/workload.hpp"

namespace rave::swarm {
namespace {

constexpr std::uint32_t kRobots = 200;
#if defined(NDEBUG) && !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
constexpr bool kFast = true;
#else
constexpr bool kFast = false;  ///< Ten to forty times slower.
#endif
constexpr std::uint64_t kShortWay = 200;
constexpr std::uint64_t kLongWay = 2000;

struct Golden {
  Sensing sensing;
  Noise noise;
  std::uint64_t short_hash;  ///< After kShortWay steps.
  std::uint64_t long_hash;   ///< After kLongWay steps.
};
/// They change with the engine, the drivers, `cruise` and the
/// generator of the workload; then look why, and write the new ones here.
constexpr Golden kGolden[] = {
    {Sensing::kA, Noise::kNone, 0x3c05eebbfadb9c88, 0xa754269e5aca0840},
    {Sensing::kB, Noise::kNone, 0xdbd6301c5584c1e4, 0x8f12f80416b71068},
    {Sensing::kA, Noise::kGaussian, 0xc05e6b8e68688ce1, 0x1fd18b94b64891a5},
};

class SwarmGolden : public testing::TestWithParam<Golden> {
 protected:
  void TearDown() override { use_targets(0); }

  /// Which sets of instructions the kernels may use; 0: all that the processor has.
  static void use_targets(std::int64_t targets) {
    hwy::SetSupportedTargetsForTest(targets);
    hwy::GetChosenTarget().DeInit();
  }

  static std::unique_ptr<sim::Engine> make(plugin::Catalogue& catalogue, int threads) {
    EXPECT_TRUE(catalogue.add_folder(std::filesystem::path(RAVE_BINARY_DIR) / "lib/rave/plugins"));
    const auto scenario =
        make_scenario({GetParam().sensing, kRobots, GetParam().noise, threads, 1}, 1);
    EXPECT_TRUE(scenario) << (scenario ? "" : scenario.error().text());
    if (!scenario) return nullptr;
    auto built = runtime::build(*scenario, catalogue, {{}, nullptr, nullptr});
    EXPECT_TRUE(built) << (built ? "" : built.error().text());
    if (!built) return nullptr;
    // So few robots would otherwise be left to one thread.
    built->spec.share_always = true;
    auto engine = sim::Engine::create(std::move(built->spec));
    EXPECT_TRUE(engine) << (engine ? "" : engine.error().text());
    return engine ? *std::move(engine) : nullptr;
  }

  /// With one thread all the way in every build; for the rest a tenth of it in slow ones.
  static void expect_golden(int threads, const std::string& what, bool all_the_way = kFast) {
    plugin::Catalogue catalogue(runtime::host_stamp());
    const auto engine = make(catalogue, threads);
    ASSERT_TRUE(engine);
    while (engine->steps_done() < (all_the_way ? kLongWay : kShortWay)) {
      const Status status = engine->step();
      ASSERT_TRUE(status) << status.error().text();
      if (engine->steps_done() == kShortWay) {
        EXPECT_EQ(engine->hash().value(), GetParam().short_hash) << what;
      }
    }
    if (!all_the_way) return;
    EXPECT_EQ(engine->hash().value(), GetParam().long_hash) << what;
  }
};

TEST_P(SwarmGolden, OneThread) { expect_golden(1, "one thread", true); }

TEST_P(SwarmGolden, TheNumberOfThreadsDoesNotMatter) {
  for (const int threads : {2, 3, 8}) {
    expect_golden(threads, fmt::format("{} threads", threads));
  }
}

TEST_P(SwarmGolden, TheSetOfInstructionsDoesNotMatter) {
  const std::int64_t all = hwy::SupportedTargets();
  ASSERT_NE(all & (all - 1), 0) << "a processor with one set of instructions shows nothing";
  for (std::int64_t rest = all; rest != 0; rest &= rest - 1) {
    use_targets(rest & -rest);
    expect_golden(1, hwy::TargetName(rest & -rest));
  }
}

INSTANTIATE_TEST_SUITE_P(Workloads, SwarmGolden, testing::ValuesIn(kGolden), [](const auto& test) {
  return std::string(to_string(test.param.sensing)) + "_" +
         std::string(to_string(test.param.noise));
});

}  // namespace
}  // namespace rave::swarm
