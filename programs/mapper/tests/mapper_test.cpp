// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "programs/testing/room.hpp"

namespace rave {
namespace {

using testing::Rig;
using testing::Room;
using testing::Suite;

constexpr double kPeriod_s = testing::ProgramUnderTest::kPeriod_s;

/// Two rooms with a door of 1 m between them.
Room two_rooms() {
  Room room;
  room.box(-3, -2, 3, 2).wall({0, -2}, {0, -0.5}).wall({0, 0.5}, {0, 2}).box(1.2, 0.8, 1.9, 1.4);
  return room;
}

struct Seen {
  double known = 0;  ///< Share of the floor that is known.
  double right = 0;  ///< Of the known cells: those that are as they are.
  double nearest_m = 1e9;
  std::uint64_t state = 0;
};

/// What the map says of the floor and of the walls of the rooms.
void judge(const Room& room, const MapView& map, Seen& seen) {
  int floor = 0;
  int known = 0;
  int right = 0;
  for (std::uint32_t row = 0; row < map.rows; ++row) {
    for (std::uint32_t column = 0; column < map.columns; ++column) {
      const Vec2 p_W{map.origin_W.x + (column + 0.5) * map.resolution_m,
                     map.origin_W.y + (row + 0.5) * map.resolution_m};
      if (std::abs(p_W.x) > 3 || std::abs(p_W.y) > 2) continue;
      const double wall_m = room.distance_m(p_W);
      // Inside of the box nothing can be seen.
      if (p_W.x > 1.2 && p_W.x < 1.9 && p_W.y > 0.8 && p_W.y < 1.4) continue;
      ++floor;
      const std::size_t at = std::size_t{row} * map.columns + column;
      if (map.seen[at] == 0) continue;
      ++known;
      // Beside a wall both are right: the cone and the cell are wider than that.
      if (wall_m < 0.15 || map.log_odds[at] < 0) ++right;
    }
  }
  seen.known = known / static_cast<double>(floor);
  seen.right = right / static_cast<double>(known);
}

Seen tour(double duration_s, Suite suite = Suite::kSixteenSonars) {
  testing::ProgramUnderTest program(rave_register_plugin, "mapper");
  Rig& rig = program.add_robot();
  rig.radius_m = 0.11;
  testing::add_suite(rig, suite);
  rig.pose = {.x_m = -2, .y_m = 0.2};
  EXPECT_EQ(program.start(1), "");
  const Room room = two_rooms();
  Seen seen;
  for (int k = 0; k < static_cast<int>(duration_s / kPeriod_s); ++k) {
    const SimTime now{k * 100'000'000LL};
    room.sense(rig, now);
    program.decide(now);
    for (int part = 0; part < 10; ++part) {
      testing::move(rig, kPeriod_s / 10);
      seen.nearest_m =
          std::min(seen.nearest_m, room.distance_m({rig.pose.x_m, rig.pose.y_m}) - rig.radius_m);
    }
  }
  judge(room, program.map(), seen);
  seen.state = rig.state;
  return seen;
}

TEST(Mapper, ExploresBothRoomsAndIsRight) {
  for (const Suite suite : {Suite::kSixteenSonars, Suite::kLaser}) {
    const Seen seen = tour(180, suite);
    EXPECT_GT(seen.known, 0.95);
    EXPECT_GT(seen.right, 0.93);
    EXPECT_GT(seen.nearest_m, 0);
  }
}

TEST(Mapper, TheSameAgainIsTheSameState) {
  const Seen seen = tour(20);
  EXPECT_NE(seen.state, 0U);
  EXPECT_EQ(tour(20).state, seen.state);
  EXPECT_NE(tour(20.1).state, seen.state);
}

TEST(Mapper, NeedsARangeSensor) {
  testing::ProgramUnderTest program(rave_register_plugin, "mapper");
  (void)program.add_robot();
  EXPECT_NE(program.start(1).find("no range sensor"), std::string::npos);
}

TEST(Mapper, DoesNotDriveIntoWhatItCannotSee) {
  testing::ProgramUnderTest program(rave_register_plugin, "mapper");
  Rig& rig = program.add_robot();
  const auto commands = testing::commands_by_age(program, [] {});
  EXPECT_EQ(commands[1], velocity_command(0, 0)) << "an old scan";
  EXPECT_NEAR(commands[3].value[0], 0, 1e-12) << "a ray that was not measured";
  (void)rig;
}

TEST(Mapper, StandsIfItMayNotExplore) {
  testing::ProgramUnderTest program(rave_register_plugin, "mapper");
  Rig& rig = program.add_robot();
  testing::add_suite(rig, Suite::kSixteenSonars);
  rig.params.set("explores", 0.0);
  ASSERT_EQ(program.start(1), "");
  const Room room = two_rooms();
  for (int k = 0; k < 20; ++k) {
    room.sense(rig, {k * 100'000'000LL});
    program.decide({k * 100'000'000LL});
    EXPECT_EQ(rig.command(), velocity_command(0, 0));
  }
  EXPECT_NE(program.map().log_odds, nullptr) << "it maps all the same";
}

}  // namespace
}  // namespace rave
