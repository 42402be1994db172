// SPDX-License-Identifier: Apache-2.0
// What must never happen to a moving robot: to overlap, to pass through, to stick where it could
// slide.
#include <gtest/gtest.h>

#include "contact_arena.hpp"
#include "rave/math/scalar.hpp"

namespace rave::sim::testing {
namespace {

// The full size where the code is fast; a sanitizer or a debugger sees the same scene smaller.
#if defined(__OPTIMIZE__) && defined(NDEBUG)
constexpr int kPackedRobots = 10'000;
constexpr int kPackedSteps = 1000;
#else
constexpr int kPackedRobots = 400;
constexpr int kPackedSteps = 300;
#endif

/// Discs and boxes on a grid that leaves them room, and the two walls of a corner at the origin.
void fill_corner(ContactArena& arena, int count) {
  arena.model.obstacles.push_back(standing(square_robot(0.05, 200), {-0.025, 100, 0}));
  arena.model.obstacles.push_back(standing(square_robot(200, 0.05), {100, -0.025, 0}));
  const int columns = static_cast<int>(std::ceil(std::sqrt(count)));
  for (int i = 0; i < count; ++i) {
    const double x_m = 0.3 + 0.42 * (i % columns);
    const double y_m = 0.3 + 0.42 * static_cast<int>(i / columns);
    const bool is_box = i % 4 == 3;
    arena.add(is_box ? square_robot(0.3, 0.2) : round_robot(0.15), {x_m, y_m, 0.7 * (i % 9)});
  }
  arena.begin();
}

TEST(ContactLimits, ACrowdPackedIntoACornerNeverOverlaps) {
  ContactArena arena(2);
  fill_corner(arena, kPackedRobots);
  ASSERT_GT(arena.least_gap(), 0);
  double deepest_m = 0;
  for (int k = 0; k < kPackedSteps; ++k) {
    for (std::uint32_t r = 0; r < arena.movers.size(); ++r) {
      RandomStream random(5, r, 0, static_cast<std::uint32_t>(k));
      arena.drive(r, {random.uniform(-0.6, 0.1), random.uniform(-0.6, 0.1)},
                  random.uniform(-0.5, 0.5));
    }
    arena.step(0.1);
    deepest_m = std::max(deepest_m, -arena.least_gap());
    // The demand is 1 mm; what the resolver promises is that nothing overlaps at all.
    ASSERT_LE(deepest_m, 1e-9) << "step " << k;
  }
  // It has become as tight as it was meant to: nearly everybody is held up by somebody.
  const auto held = std::count(arena.limited.begin(), arena.limited.end(), std::uint8_t{1});
  EXPECT_GT(held, kPackedRobots * 9 / 10);
  EXPECT_GT(arena.phase->resolved(), static_cast<std::size_t>(kPackedRobots) * 9 / 10);
}

/// A wall 5 cm thick and 40 m long that faces `heading_rad`, `distance_m` from the origin.
world::Obstacle thin_wall(double heading_rad, double distance_m) {
  const Vec2 normal{cos(heading_rad), sin(heading_rad)};
  const Vec2 centre = (distance_m + 0.025) * normal;
  return standing(square_robot(0.05, 40), {centre.x, centre.y, heading_rad});
}

TEST(ContactLimits, WhoPressesOnAWallSlidesAlongIt) {
  constexpr double kSpeed_mps = 0.3;
  constexpr int kSteps = 60;
  for (int wall_deg = 0; wall_deg < 360; wall_deg += 15) {
    for (const int press_deg : {-70, -45, -20, 20, 45, 70}) {
      for (const bool is_box : {false, true}) {
        const double facing_rad = deg_to_rad(wall_deg);
        ContactArena arena;
        arena.model.obstacles.push_back(thin_wall(facing_rad, 0.4));
        arena.add(is_box ? square_robot(0.4, 0.2) : round_robot(0.15),
                  {0, 0, wrap_angle(deg_to_rad(3.0 * wall_deg + press_deg))});
        arena.begin();
        const double heading_rad = facing_rad + deg_to_rad(press_deg);
        const Vec2 v_W = kSpeed_mps * Vec2{cos(heading_rad), sin(heading_rad)};
        for (int k = 0; k < kSteps; ++k) {
          arena.drive(0, v_W);
          arena.step(0.1);
        }
        const Vec2 along{-sin(facing_rad), cos(facing_rad)};
        const double free_m = dot(along, v_W) * 0.1 * kSteps;
        EXPECT_NEAR(dot(along, arena.movers[0].X_WR.position()), free_m, 0.02 * std::abs(free_m))
            << "wall " << wall_deg << ", pressed at " << press_deg << ", box " << is_box;
        const double gap_m = arena.gap_to(arena.model.obstacles[0], 0);
        EXPECT_GT(gap_m, 0) << "wall " << wall_deg << ", pressed at " << press_deg;
        EXPECT_LT(gap_m, 1e-3) << "it never came to the wall";
      }
    }
  }
}

TEST(ContactLimits, NobodyTunnelsThroughAThinWall) {
  constexpr double kSpeed_mps = 3;
  RandomStream random(11, 1, 2, 3);
  int stopped = 0;
  constexpr int kWorlds = 2000;
  for (int i = 0; i < kWorlds; ++i) {
    const double facing_rad = random.uniform(-kPi, kPi);
    const Vec2 normal{cos(facing_rad), sin(facing_rad)};
    const double distance_m = random.uniform(0.35, 1.5);
    ContactArena arena;
    arena.model.obstacles.push_back(thin_wall(facing_rad, distance_m));
    const bool is_box = i % 2 == 1;
    arena.add(is_box ? square_robot(random.uniform(0.02, 0.5), random.uniform(0.02, 0.4))
                     : round_robot(random.uniform(0.01, 0.3)),
              {0, 0, random.uniform(-kPi, kPi)});
    arena.begin();
    const double heading_rad = facing_rad + random.uniform(-1.4, 1.4);
    const double spin_radps = i % 3 == 0 ? random.uniform(-8, 8) : 0;
    for (int k = 0; k < 25; ++k) {
      arena.drive(0, kSpeed_mps * Vec2{cos(heading_rad), sin(heading_rad)}, spin_radps);
      arena.step(0.1);
      ASSERT_LT(dot(normal, arena.movers[0].X_WR.position()), distance_m)
          << "world " << i << ": it is in or behind the wall in step " << k;
      ASSERT_GT(arena.gap_to(arena.model.obstacles[0], 0), 0) << "world " << i << ", step " << k;
    }
    stopped += arena.limited[0];
  }
  EXPECT_GT(stopped, kWorlds * 8 / 10) << "few came to the wall at all";
}

TEST(ContactLimits, NobodyTunnelsThroughARobot) {
  constexpr double kSpeed_mps = 3;
  RandomStream random(12, 1, 2, 3);
  int stopped = 0;
  constexpr int kWorlds = 1000;
  for (int i = 0; i < kWorlds; ++i) {
    // A plate that comes towards the other, which goes towards it: 6 m/s at each other.
    const double facing_rad = random.uniform(-kPi, kPi);
    const Vec2 normal{cos(facing_rad), sin(facing_rad)};
    const Vec2 place = random.uniform(0.35, 2) * normal;
    const bool is_box = i % 2 == 1;
    const bool plate_first = i % 4 < 2;
    ContactArena arena;
    const world::Body small =
        is_box ? square_robot(random.uniform(0.02, 0.3), random.uniform(0.02, 0.3))
               : round_robot(random.uniform(0.01, 0.2));
    const Pose2 X_WP{place.x, place.y, facing_rad};
    const Pose2 X_WR{0, 0, random.uniform(-kPi, kPi)};
    const std::uint32_t first =
        plate_first ? arena.add(square_robot(0.05, 10), X_WP) : arena.add(small, X_WR);
    const std::uint32_t second =
        plate_first ? arena.add(small, X_WR) : arena.add(square_robot(0.05, 10), X_WP);
    const std::uint32_t plate = plate_first ? first : second;
    const std::uint32_t robot = plate_first ? second : first;
    arena.begin();
    const double heading_rad = facing_rad + random.uniform(-1, 1);
    const double plate_mps = i % 3 == 0 ? 0 : kSpeed_mps;
    bool was_limited = false;
    for (int k = 0; k < 10; ++k) {
      arena.drive(robot, kSpeed_mps * Vec2{cos(heading_rad), sin(heading_rad)}, i % 5 == 0 ? 4 : 0);
      arena.drive(plate, -plate_mps * normal);
      arena.step(0.1);
      const Vec2 p_PR =
          transform_back(arena.movers[plate].X_WR, arena.movers[robot].X_WR.position());
      ASSERT_LT(p_PR.x, 0) << "world " << i << ": it is in or behind the plate in step " << k;
      ASSERT_LT(std::abs(p_PR.y), 5) << "it may go round the plate";
      ASSERT_GT(arena.gap(plate, robot), 0) << "world " << i << ", step " << k;
      was_limited = was_limited || arena.limited[robot] != 0;
    }
    stopped += was_limited ? 1 : 0;
  }
  EXPECT_GT(stopped, kWorlds * 8 / 10) << "few met at all";
}

}  // namespace
}  // namespace rave::sim::testing
