// SPDX-License-Identifier: Apache-2.0
#include "../src/edit_limits.hpp"

#include <gtest/gtest.h>

#include "rave/protocol/obstacle_messages.hpp"

namespace rave::manager {
namespace {

using Change = sim::ObstacleChange::Kind;
using std::chrono::milliseconds;

/// An obstacle of so many pieces.
sim::ObstacleChange crate(std::uint32_t id, std::size_t pieces = 1) {
  sim::ObstacleChange change;
  change.id = BodyId(id);
  change.name = "crate";
  change.body.shapes.assign(pieces, world::make_disc({}, 0.2, 0, 1).value());
  return change;
}

TEST(EditLimits, SoManyASecondAndNotMore) {
  EditLimits limits;
  auto now = EditLimits::Clock::now();
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(limits.take(crate(7), now)) << i;
  const Status refused = limits.take(crate(7), now);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("too many edits at once"), std::string::npos);
  now += milliseconds(50);
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(limits.take(crate(7), now)) << i;
  EXPECT_FALSE(limits.take(crate(7), now));
}

TEST(EditLimits, InAllNotMoreThanOneMessageHolds) {
  EditLimits limits;
  auto now = EditLimits::Clock::now();
  const std::size_t each = lock_step::wire_bytes(crate(7, 64));
  const std::size_t most = lock_step::kMostObstacleBytes / each;
  for (std::uint32_t i = 0; i < most; ++i) {
    now += milliseconds(10);
    ASSERT_TRUE(limits.take(crate(i, 64), now)) << i;
    limits.made(crate(i, 64));
  }
  now += milliseconds(1000);
  const Status refused = limits.take(crate(9, 64), now);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("were added or changed for hosts that join late"),
            std::string::npos);
  sim::ObstacleChange gone;
  gone.kind = Change::kRemove;
  gone.name = "crate";
  gone.id = BodyId(3);
  EXPECT_TRUE(limits.take(gone, now)) << "there is room for one that goes";
}

TEST(EditLimits, AnObstacleThatMovesAThousandTimesCountsOnce) {
  EditLimits limits;
  limits.made(crate(7));
  sim::ObstacleChange move = crate(7);
  move.kind = Change::kMove;
  for (int i = 0; i < 100'000; ++i) limits.made(move);
  EXPECT_TRUE(limits.take(crate(8), EditLimits::Clock::now()));
}

TEST(EditLimits, WhatTheBusCannotCarryIsRefused) {
  EditLimits limits;
  sim::ObstacleChange change = crate(7);
  change.name = std::string(65, 'n');
  EXPECT_FALSE(limits.take(change, EditLimits::Clock::now()));
}

TEST(EditLimits, OfAScenarioToo) {
  sim::EngineSpec spec;
  spec.obstacle_changes.push_back({0, crate(7)});
  EXPECT_TRUE(check_scheduled(spec));
  spec.obstacle_changes.assign(3000, {0, crate(7, 64)});
  const Status refused = check_scheduled(spec);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("changes obstacles 3000 times"), std::string::npos);
}

}  // namespace
}  // namespace rave::manager
