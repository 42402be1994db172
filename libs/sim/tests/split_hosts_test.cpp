// SPDX-License-Identifier: Apache-2.0
// Hosts that leave a shared world, come back, or end its run.
#include "split_run.hpp"
#include "split_scene.hpp"

namespace rave::sim::testing::crowd {
namespace {

TEST(Split, TheOthersGoOnWithoutAHostAndItComesBack) {
  constexpr std::uint32_t kHost = 1;
  SplitRun run([] { return scene(1); }, interleaved(3));
  for (int k = 0; k < 60; ++k) ASSERT_TRUE(run.advance());
  run.hosts[kHost] = nullptr;
  const auto step_without = [&] {
    std::vector<const HostReport*> reports;
    for (std::uint32_t h = 0; h < 3; ++h) {
      if (h == kHost) {
        run.authority->speak_for(h, run.reports[h]);
      } else {
        ASSERT_TRUE(run.hosts[h]->apply(run.world));
        ASSERT_TRUE(run.hosts[h]->propose(run.reports[h]));
      }
      reports.push_back(&run.reports[h]);
    }
    const Status stepped = run.authority->step(reports, run.world);
    ASSERT_TRUE(stepped) << stepped.error().text();
  };
  for (int k = 0; k < 20; ++k) ASSERT_NO_FATAL_FAILURE(step_without());
  std::size_t moving = 0;
  for (std::uint32_t r = kHost; r < kRobots; r += 3) {
    const bool stands = run.world.vx_mps[r] == 0 && run.world.wz_radps[r] == 0;
    moving += stands ? 0U : 1U;
  }
  EXPECT_EQ(moving, 0U);
  // Where those are that have a source of their pose is what was told last, and nothing new.
  std::size_t told = 0;
  for (const PoseReport& pose : run.world.poses) {
    if (pose.robot.value() % 3 != kHost) continue;
    ++told;
    EXPECT_TRUE(pose.reported.known && pose.reported.stale) << pose.robot.value();
    EXPECT_EQ(pose.reported.velocity.vx, 0) << pose.robot.value();
  }
  EXPECT_GE(told, 2U);

  EngineSpec spec = scene(1);
  spec.local.emplace();
  for (std::uint32_t r = kHost; r < kRobots; r += 3) spec.local->emplace_back(r);
  run.hosts[kHost] = make_engine(std::move(spec));
  ASSERT_TRUE(run.hosts[kHost]->propose(run.reports[kHost]));
  EXPECT_EQ(run.reports[kHost].step, 0U);
  const Status joined = run.hosts[kHost]->join(run.world, run.authority->state());
  ASSERT_TRUE(joined) << joined.error().text();
  // Where its own robots are it knows best.
  EXPECT_FALSE(run.hosts[kHost]->reported(kRealOfHost1).stale);
  // It grew before this host was there.
  EXPECT_NE(scene(1).world.robots[kGrowing.value()].radius_m(),
            run.hosts[0]->body_radius_m(kGrowing));
  EXPECT_EQ(run.hosts[kHost]->body_radius_m(kGrowing), run.hosts[0]->body_radius_m(kGrowing));
  ASSERT_TRUE(run.hosts[0]->apply(run.world));
  ASSERT_TRUE(run.hosts[2]->apply(run.world));
  ASSERT_TRUE(run.exchange());
  EXPECT_EQ(run.reports[kHost].step, run.reports[0].step);
  for (int k = 0; k < 40; ++k) ASSERT_TRUE(run.advance());
  for (std::uint32_t r = kHost; r < kRobots; r += 3) {
    moving += run.world.vx_mps[r] != 0 || run.world.wz_radps[r] != 0 ? 1U : 0U;
  }
  EXPECT_GT(moving, 5U);
}

TEST(Split, AHostThatIsDoneEndsTheRunOfAll) {
  SplitRun run([] { return scene(1); }, interleaved(3));
  for (int k = 0; k < 3; ++k) ASSERT_TRUE(run.advance());
  EXPECT_FALSE(run.world.last);
  ASSERT_TRUE(run.apply());
  std::vector<const HostReport*> all;
  for (std::size_t h = 0; h < run.hosts.size(); ++h) {
    ASSERT_TRUE(run.hosts[h]->propose(run.reports[h]));
    all.push_back(&run.reports[h]);
  }
  run.reports[1].state = HostState::kDone;
  ASSERT_TRUE(run.authority->step(all, run.world));
  EXPECT_TRUE(run.world.last);
}

}  // namespace
}  // namespace rave::sim::testing::crowd
