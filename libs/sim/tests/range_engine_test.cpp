// SPDX-License-Identifier: Apache-2.0
#include "rave/sim/range_engine.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>

#include "../src/listed_fan.hpp"
#include "rave/base/random.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math_testing/each_target.hpp"

namespace rave::sim {
namespace {

world::Body body_of(std::vector<world::Shape> shapes, Layer layer) {
  world::Body body;
  body.shapes = std::move(shapes);
  body.layer = layer;
  return body;
}

world::Obstacle disc_at(double x, double y, double radius_m) {
  return {body_of({world::make_disc({}, radius_m, 0, 1).value()}, Layer::kVirtualObstacles),
          {x, y, 0}};
}

world::Obstacle polygon_at(const Pose2& X_WB, const std::vector<Vec2>& outline, double z1_m = 1) {
  return {body_of(world::make_prisms(outline, 0, z1_m).value(), Layer::kVirtualObstacles), X_WB};
}

std::vector<Vec2> box(double length_m, double width_m) {
  const double x = length_m / 2;
  const double y = width_m / 2;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

struct Fan {
  std::vector<double> bearings;
  FanTable table;
};

Fan fan_of(std::uint32_t rays, double opening_rad, double range_max_m,
           std::uint32_t rays_per_reading = 1) {
  Fan fan;
  for (std::uint32_t i = 0; i < rays; ++i) {
    fan.bearings.push_back(rays == 1 ? 0 : -opening_rad / 2 + opening_rad * i / (rays - 1));
  }
  FanQuery query;
  query.bearings_rad = fan.bearings.data();
  query.ray_count = rays;
  query.rays_per_reading = rays_per_reading;
  query.range_max_m = range_max_m;
  fan.table = FanTable::make(query, kAllLayers);
  return fan;
}

struct Reading {
  std::vector<float> ranges;
  std::vector<std::uint32_t> bodies;
};

Reading cast(const world::Snapshot& world, const FanTable& fan, const Pose2& X_WS, double z_m = 0.5,
             BodyId owner = BodyId()) {
  Reading reading;
  reading.ranges.resize(fan.readings());
  reading.bodies.resize(fan.readings());
  FanScratch scratch;
  cast_fan(world, fan, sensor_place(X_WS, Pose2{}), z_m, owner, scratch, reading.ranges,
           reading.bodies);
  return reading;
}

TEST(CastFan, ReadsABoxAheadToTheMillimetre) {
  world::WorldModel model;
  model.obstacles.push_back(polygon_at({3, 0, 0}, box(1, 1)));
  const world::Snapshot world(model);
  const auto reading = cast(world, fan_of(1, 0, 8).table, {0, 0.2, 0});
  EXPECT_NEAR(reading.ranges[0], 2.5, 1e-6);
  EXPECT_EQ(reading.bodies[0], 0U);
}

TEST(CastFan, NoReturnIsInfinityAndNoBody) {
  world::WorldModel model;
  model.obstacles.push_back(disc_at(3, 0, 0.5));
  const world::Snapshot world(model);
  const auto behind = cast(world, fan_of(1, 0, 8).table, {0, 0, kPi});
  EXPECT_TRUE(std::isinf(behind.ranges[0]));
  EXPECT_EQ(behind.bodies[0], BodyId::kNone);
  const auto too_far = cast(world, fan_of(1, 0, 2).table, {0, 0, 0});
  EXPECT_TRUE(std::isinf(too_far.ranges[0]));
}

TEST(CastFan, ABodyBelowTheSensorIsNotSeen) {
  world::WorldModel model;
  model.obstacles.push_back(polygon_at({3, 0, 0}, box(1, 1), 0.2));
  const world::Snapshot world(model);
  const auto fan = fan_of(1, 0, 8);
  EXPECT_TRUE(std::isinf(cast(world, fan.table, {}, 0.3).ranges[0]));
  EXPECT_NEAR(cast(world, fan.table, {}, 0.1).ranges[0], 2.5, 1e-6);
}

TEST(CastFan, ALayerThatIsNotSensedIsNotSeen) {
  world::WorldModel model;
  model.obstacles.push_back(polygon_at({3, 0, 0}, box(1, 1)));
  const world::Snapshot world(model);
  auto fan = fan_of(1, 0, 8);
  fan.table.layers = static_cast<LayerMask>(Layer::kMappedReal);
  EXPECT_TRUE(std::isinf(cast(world, fan.table, {}).ranges[0]));
}

TEST(CastFan, FromInsideABodyEverythingIsZero) {
  world::WorldModel model;
  model.obstacles.push_back(polygon_at({0, 0, 0.3}, box(2, 2)));
  model.obstacles.push_back(disc_at(5, 0, 1));
  const world::Snapshot world(model);
  for (const float range : cast(world, fan_of(9, 6, 8).table, {0.1, 0.2, 1}).ranges) {
    EXPECT_EQ(range, 0.0F);
  }
  for (const float range : cast(world, fan_of(9, 6, 8).table, {5.5, 0.2, 1}).ranges) {
    EXPECT_EQ(range, 0.0F);
  }
}

TEST(CastFan, ARobotNeverSeesItself) {
  world::WorldModel model;
  model.robots.push_back(
      body_of({world::make_disc({}, 0.2, 0, 1).value()}, Layer::kSimulatedRobots));
  world::Snapshot world(model);
  world.set_robot(RobotId(0), {{1, 1, 0}, {}, true});
  world.rebuild();
  const auto fan = fan_of(16, 6, 8);
  for (const float range : cast(world, fan.table, {1, 1, 0}, 0.5, BodyId(0)).ranges) {
    EXPECT_TRUE(std::isinf(range));
  }
}

TEST(CastFan, AConeReadsItsNearestRayNotItsCentre) {
  world::WorldModel model;
  model.obstacles.push_back(disc_at(4, 0, 0.5));
  model.obstacles.push_back(disc_at(1.5, 0.3, 0.1));
  const world::Snapshot world(model);
  const auto cone = fan_of(31, 0.5, 8, 31);
  const auto reading = cast(world, cone.table, {});
  ASSERT_EQ(reading.ranges.size(), 1U);
  EXPECT_NEAR(reading.ranges[0], std::sqrt(1.5 * 1.5 + 0.09) - 0.1, 0.01);
  EXPECT_EQ(reading.bodies[0], 1U);
}

/// A world of boxes, polygons of 3 to 32 corners and discs around a centre.
world::WorldModel random_world(std::uint32_t seed, Vec2 centre) {
  RandomStream random(seed, 1, 2, 3);
  world::WorldModel model;
  for (int i = 0; i < 12; ++i) {
    const Pose2 X_WB{centre.x + random.uniform(-6, 6), centre.y + random.uniform(-6, 6),
                     random.uniform(-kPi, kPi)};
    const double kind = random.uniform();
    if (kind < 0.3) {
      model.obstacles.push_back(disc_at(X_WB.x, X_WB.y, random.uniform(0.05, 1.2)));
    } else if (kind < 0.6) {
      model.obstacles.push_back(
          polygon_at(X_WB, box(random.uniform(0.05, 4), random.uniform(0.05, 1))));
    } else {
      const int corners = 3 + static_cast<int>(random.uniform() * 30);
      std::vector<Vec2> outline;
      const double radius = random.uniform(0.1, 1);
      for (int k = 0; k < corners; ++k) {
        const SinCos turn = sincos(2 * kPi * k / corners);
        outline.push_back({radius * turn.cos, 0.7 * radius * turn.sin});
      }
      model.obstacles.push_back(polygon_at(X_WB, outline));
    }
  }
  return model;
}

/// More of them than are made out together.
void add_discs(std::uint32_t seed, Vec2 centre, world::WorldModel& model) {
  RandomStream random(seed, 7, 7, 7);
  for (int i = 0; i < 20; ++i) {
    model.obstacles.push_back(disc_at(centre.x + random.uniform(-6, 6),
                                      centre.y + random.uniform(-6, 6), random.uniform(0.05, 0.3)));
  }
}

/// The reference: every shape, one ray at a time, in double.
double brute_force(const world::Snapshot& world, Vec2 p, Vec2 direction, double inflate_m) {
  double nearest = world::kNoHit;
  for (const world::PlacedShape& shape : world.shapes()) {
    double range = world::kNoHit;
    if (shape.kind == world::ShapeKind::kDisc) {
      range = world::cast_disc(p, direction, shape.centre_W, shape.radius_m + inflate_m);
    } else {
      std::vector<Vec2> vertices(world.vertices_W(shape).begin(), world.vertices_W(shape).end());
      Vec2 middle;
      for (const Vec2 v : vertices)
        middle = middle + (1.0 / static_cast<double>(vertices.size())) * v;
      for (Vec2& v : vertices) {
        const Vec2 out = v - middle;
        v = v + (inflate_m / std::sqrt(squared_norm(out))) * out;
      }
      range = world::cast_polygon(p, direction, vertices);
    }
    nearest = range < nearest ? range : nearest;
  }
  return nearest;
}

/// Near the origin and a kilometre away, from inside and outside of bodies.
TEST(CastFan, AgreesWithBruteForceInRandomWorlds) {
  std::size_t checked = 0;
  for (std::uint32_t seed = 0; seed < 3000; ++seed) {
    const Vec2 centre = seed % 2 == 0 ? Vec2{0, 0} : Vec2{700, -750};
    world::WorldModel model = random_world(seed, centre);
    // Far from where the index begins, candidates are found in another way.
    if (seed % 5 == 0) add_discs(seed, centre, model);
    if (seed % 7 == 0) model.obstacles.push_back(disc_at(centre.x - 3000, centre.y - 3000, 1));
    const world::Snapshot world(model);
    RandomStream random(seed, 9, 9, 9);
    const Pose2 X_WS{centre.x + random.uniform(-5, 5), centre.y + random.uniform(-5, 5),
                     random.uniform(-kPi, kPi)};
    // Few rays are all tried, many are found by bearing; 100 rays over half a circle leave a gap.
    const auto fan = seed % 3 == 0   ? fan_of(16, 2 * kPi * 15 / 16, 8)
                     : seed % 3 == 1 ? fan_of(61, 2 * kPi * 60 / 61, 8)
                                     : fan_of(100, kPi, 8);
    const auto reading = cast(world, fan.table, X_WS);
    for (std::size_t ray = 0; ray < reading.ranges.size(); ++ray) {
      const SinCos turn = sincos(X_WS.yaw + fan.bearings[ray]);
      const Vec2 direction{turn.cos, turn.sin};
      const double reference = brute_force(world, X_WS.position(), direction, 0);
      const double expected = reference <= 8 ? reference : world::kNoHit;
      const double measured = reading.ranges[ray];
      const bool equal = measured == expected || std::abs(measured - expected) < 1e-4;
      // A grazing ray may fall either way: bodies 0.1 mm larger and smaller bracket it.
      const double large = brute_force(world, X_WS.position(), direction, 1e-4);
      const double small = brute_force(world, X_WS.position(), direction, -1e-4);
      const double low = large - 1e-4;
      const double high = (small <= 8 ? small : world::kNoHit) + 1e-4;
      ASSERT_TRUE(equal || (measured >= low && measured <= high))
          << "world " << seed << " ray " << ray << ": " << measured << ", reference " << reference;
      ++checked;
    }
  }
  EXPECT_EQ(checked, 1000U * (16 + 61 + 100));
}

/// A wide field: shapes on one in some 20 m², and a long wall across it now and then.
world::WorldModel wide_world(std::uint32_t seed, Vec2 centre) {
  RandomStream random(seed, 6, 6, 6);
  world::WorldModel model;
  for (std::uint32_t i = 0; i < 12; ++i) {
    world::WorldModel some = random_world(
        17 * seed + i, {centre.x + random.uniform(-40, 40), centre.y + random.uniform(-40, 40)});
    for (world::Obstacle& obstacle : some.obstacles) model.obstacles.push_back(std::move(obstacle));
  }
  if (seed % 3 == 0)
    model.obstacles.push_back(polygon_at({centre.x, centre.y + 30, 0.1}, box(90, 0.2)));
  return model;
}

/// One ray, several, several that are no fan, and cones; up to farther than the world.
FanTable walked_fan(std::uint32_t seed) {
  const double range_m = seed % 4 == 0 ? 5 : seed % 4 == 1 ? 40 : seed % 4 == 2 ? 300 : 1e4;
  switch (seed % 5) {
    case 0:
      return fan_of(1, 0, range_m).table;
    case 1:
      return fan_of(3, 0.2, range_m).table;
    case 2:
      return fan_of(kMostWalked, 2 * kPi * 15 / 16, range_m).table;
    case 3:
      return fan_of(14, 0.5, range_m, 7).table;
    default:
      return fan_of(8, 2 * kPi, range_m).table;  // the first and the last are one
  }
}

TEST(CastFan, AlongItsRaysItFindsToTheBitWhatIsAllAround) {
  std::size_t hits = 0;
  std::size_t none = 0;
  for (std::uint32_t seed = 0; seed < 2000; ++seed) {
    const Vec2 centre = seed % 2 == 0 ? Vec2{0, 0} : Vec2{5000, -750};
    world::WorldModel model = wide_world(seed, centre);
    constexpr std::uint32_t kRobots = 10;
    for (std::uint32_t r = 0; r < kRobots; ++r) {
      model.robots.push_back(
          body_of({world::make_disc({}, 0.3, 0, 1).value()}, Layer::kRealRobots));
    }
    world::Snapshot world(model);
    RandomStream random(seed, 8, 8, 8);
    for (std::uint32_t r = 0; r < kRobots; ++r) {
      const Pose2 X_WR{centre.x + random.uniform(-40, 40), centre.y + random.uniform(-40, 40), 0};
      world.set_robot(RobotId(r), {X_WR, {}, r != 3});
    }
    world.rebuild();
    const SensorPlace place =
        sensor_place(Pose2{centre.x + random.uniform(-60, 60), centre.y + random.uniform(-60, 60),
                           random.uniform(-kPi, kPi)},
                     Pose2{});
    const FanTable fan = walked_fan(seed);
    FanScratch scratch;
    Reading around{std::vector<float>(fan.readings()), std::vector<std::uint32_t>(fan.readings())};
    Reading along = around;
    cast_fan_around(world, fan, place, 0.5, BodyId(seed % 40), scratch, around.ranges,
                    around.bodies);
    cast_fan_along(world, fan, place, 0.5, BodyId(seed % 40), scratch, along.ranges, along.bodies);
    ASSERT_EQ(std::memcmp(around.ranges.data(), along.ranges.data(),
                          around.ranges.size() * sizeof(float)),
              0)
        << "world " << seed;
    ASSERT_EQ(around.bodies, along.bodies) << "world " << seed;
    for (const float range_m : along.ranges) ++(std::isfinite(range_m) ? hits : none);
  }
  EXPECT_GT(hits, 1000U);
  EXPECT_GT(none, 1000U);
}

TEST(CastFan, WalksWhereThatIsExpectedToTakeLess) {
  world::WorldModel model;
  for (int i = 0; i < 4900; ++i) {
    const int row = i / 70;
    model.obstacles.push_back(disc_at(3 * (i % 70), 3 * row, 0.3));
  }
  const world::Snapshot world(model);
  EXPECT_TRUE(walk_pays(world, fan_of(1, 0, 100).table));
  EXPECT_TRUE(walk_pays(world, fan_of(4, 0.2, 1000).table));
  EXPECT_FALSE(walk_pays(world, fan_of(16, 2 * kPi * 15 / 16, 3).table));
  EXPECT_FALSE(walk_pays(world, fan_of(180, kPi, 100).table)) << "more rays than are walked";
  // Where hardly anything stands, most of the way is rows of empty cells.
  world::WorldModel sparse;
  for (int i = 0; i < 1024; ++i) {
    const int row = i / 32;
    sparse.obstacles.push_back(disc_at(62 * (i % 32), 62 * row, 0.3));
  }
  const world::Snapshot desert(sparse);
  EXPECT_FALSE(walk_pays(desert, fan_of(16, 2 * kPi * 15 / 16, 500).table));
}

TEST(CastFan, FindsWhatOnlyJustComesIntoRange) {
  const auto fan = fan_of(16, 2 * kPi * 15 / 16, 3);
  for (std::uint32_t i = 0; i < 2000; ++i) {
    // A sensor up to 2 km from the corner of the index, and a disc that reaches to 3 m less a hair.
    RandomStream random(i, 4, 4, 4);
    const Vec2 p{random.uniform(0, 2000), random.uniform(0, 2000)};
    const double bearing = 2 * kPi * (i % 16) / 16 - kPi * 15 / 16;
    const SinCos turn = sincos(bearing);
    const double distance = 3 + 0.15 - 1e-4 * random.uniform(0.05, 1);
    world::WorldModel model;
    model.obstacles.push_back(disc_at(-1, -1, 0.1));
    model.obstacles.push_back(disc_at(p.x + distance * turn.cos, p.y + distance * turn.sin, 0.15));
    const world::Snapshot world(model);
    const auto reading = cast(world, fan.table, {p.x, p.y, 0});
    EXPECT_EQ(reading.bodies[i % 16], 1U) << i << ": " << reading.ranges[i % 16];
  }
}

TEST(CastFan, WidestAndNarrowestInstructionsGiveTheSameBits) {
  std::vector<std::vector<Reading>> by_target;
  for_each_target([&](const char* /*name*/) {
    std::vector<Reading> readings;
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
      world::WorldModel model = random_world(seed, {40, -30});
      add_discs(seed, {40, -30}, model);
      const world::Snapshot world(model);
      RandomStream random(seed, 9, 9, 9);
      const Pose2 X_WS{random.uniform(35, 45), random.uniform(-35, -25), random.uniform(-kPi, kPi)};
      readings.push_back(cast(world, fan_of(seed % 2 == 0 ? 16 : 181, 3.5, 8).table, X_WS));
    }
    by_target.push_back(std::move(readings));
  });
  ASSERT_GE(by_target.size(), 2U) << "a processor with one set of instructions shows nothing";
  for (std::size_t target = 1; target < by_target.size(); ++target) {
    for (std::size_t i = 0; i < by_target[0].size(); ++i) {
      const Reading& a = by_target[0][i];
      const Reading& b = by_target[target][i];
      ASSERT_EQ(std::memcmp(a.ranges.data(), b.ranges.data(), a.ranges.size() * sizeof(float)), 0)
          << "world " << i << ", set " << target;
      ASSERT_EQ(a.bodies, b.bodies) << "world " << i << ", set " << target;
    }
  }
}

}  // namespace
}  // namespace rave::sim
