// SPDX-License-Identifier: Apache-2.0
#include "rave/world/snapshot.hpp"

#include <gtest/gtest.h>

#include <array>

#include "rave/base/random.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math_testing/polygon_measures.hpp"

namespace rave::world {
namespace {

Body disc_body(double radius_m, Layer layer, double z1_m = 1) {
  Body body;
  body.shapes.push_back(make_disc({}, radius_m, 0, z1_m).value());
  body.layer = layer;
  return body;
}

/// A tube with a code, a low robot beside the line to it, and a looking robot.
WorldModel tube_and_robots() {
  WorldModel model;
  Body tube = disc_body(0.05, Layer::kMappedReal);
  tube.code = 72;
  tube.code_z0_m = 0.1;
  tube.code_z1_m = 0.9;
  model.obstacles.push_back({tube, {4, 0, 0}});
  model.robots.push_back(disc_body(0.165, Layer::kRealRobots, 0.1));
  Body coded = disc_body(0.165, Layer::kSimulatedRobots, 0.1);
  coded.code = 14;
  model.robots.push_back(coded);
  return model;
}

TEST(Snapshot, SeesOverALowRobotButNotThroughIt) {
  const WorldModel model = tube_and_robots();
  Snapshot world(model);
  world.set_robot(RobotId(0), {{0, 0, 0}, {}, true});
  world.set_robot(RobotId(1), {{2, 0, 0}, {}, true});
  world.rebuild();
  EXPECT_TRUE(world.visible({0, 0}, {4, 0}, 0.3, kAllLayers, BodyId(1), BodyId(0)));
  EXPECT_FALSE(world.visible({0, 0}, {4, 0}, 0.05, kAllLayers, BodyId(1), BodyId(0)));
  EXPECT_TRUE(world.visible({0, 0}, {4, 0}, 0.05, static_cast<LayerMask>(Layer::kMappedReal),
                            BodyId(1), BodyId(0)));
}

TEST(Snapshot, ListsLandmarksOfObstaclesAndOfRobotsThatAreThere) {
  const WorldModel model = tube_and_robots();
  Snapshot world(model);
  world.set_robot(RobotId(1), {{2, 1, 0}, {}, false});
  world.rebuild();
  ASSERT_EQ(world.landmarks().size(), 1U);
  EXPECT_EQ(world.landmarks()[0].code, 72);
  world.set_robot(RobotId(1), {{2, 1, 0}, {}, true});
  world.rebuild();
  ASSERT_EQ(world.landmarks().size(), 2U);
  EXPECT_EQ(world.landmarks()[1].code, 14);
  EXPECT_EQ(world.landmarks()[1].robot, RobotId(1));
  EXPECT_EQ(world.landmarks()[1].p_WL, (Vec2{2, 1}));
}

TEST(Snapshot, ARobotThatIsNotThereIsNeitherSeenNorFound) {
  const WorldModel model = tube_and_robots();
  Snapshot world(model);
  world.set_robot(RobotId(0), {{0, 0, 0}, {}, false});
  world.rebuild();
  EXPECT_FALSE(world.cast({-1, 0}, 0.05, 0, 3, kAllLayers, BodyId()).body.valid());
  std::array<RobotId, 4> found;
  EXPECT_EQ(world.robots_within({0, 0}, 100, found), 0U);
}

TEST(Snapshot, FindsRobotsWithinADistanceInTheirOrder) {
  WorldModel model;
  for (int i = 0; i < 50; ++i) model.robots.push_back(disc_body(0.1, Layer::kSimulatedRobots));
  Snapshot world(model);
  RandomStream random(1, 1, 1, 1);
  std::vector<Vec2> places;
  for (std::uint32_t r = 0; r < 50; ++r) {
    places.push_back({random.uniform(-10, 10), random.uniform(-10, 10)});
    world.set_robot(RobotId(r), {{places[r].x, places[r].y, 0}, {}, true});
  }
  world.rebuild();
  std::vector<RobotId> expected;
  for (std::uint32_t r = 0; r < 50; ++r) {
    if (squared_norm(places[r] - Vec2{1, 2}) <= 25) expected.emplace_back(r);
  }
  std::array<RobotId, 50> found;
  const std::uint32_t count = world.robots_within({1, 2}, 5, found);
  EXPECT_EQ(std::vector<RobotId>(found.begin(), found.begin() + count), expected);
  EXPECT_GT(count, 3U);
  std::array<RobotId, 2> few;
  EXPECT_EQ(world.robots_within({1, 2}, 5, few), count) << "tells how many there are in all";
  EXPECT_EQ(few[1], expected[1]);
}

TEST(Snapshot, ARayMeetsTheNearestBody) {
  const WorldModel model = tube_and_robots();
  Snapshot world(model);
  world.set_robot(RobotId(0), {{0, 0, 0}, {}, true});
  world.set_robot(RobotId(1), {{2, 0.1, 0}, {}, true});
  world.rebuild();
  const RayHit hit = world.cast({0, 0}, 0.05, 0, 8, kAllLayers, world.body_of(RobotId(0)));
  EXPECT_EQ(hit.body, world.body_of(RobotId(1)));
  EXPECT_NEAR(hit.range_m, 2 - std::sqrt(0.165 * 0.165 - 0.01), 1e-12);
}

/// Boxes and discs, some of them absent.
void scatter(Snapshot& world) {
  for (std::uint32_t r = 0; r < world.robot_count(); ++r) {
    RandomStream random(4, r, 1, 1);
    world.set_robot(
        RobotId(r),
        {{random.uniform(-9, 9), random.uniform(-9, 9), 0.1 * r}, {}, random.bits() % 4 != 0});
  }
}

/// Rays of all lengths over a field of discs and walls: what a look at every shape finds.
TEST(Snapshot, ARayIsFollowedToWhatALinearSearchFinds) {
  std::size_t hits = 0;
  for (std::uint32_t seed = 0; seed < 400; ++seed) {
    RandomStream random(seed, 5, 5, 5);
    WorldModel model;
    for (int i = 0; i < 60; ++i) {
      const Pose2 X_WB{random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(-kPi, kPi)};
      if (i % 3 != 0) {
        model.obstacles.push_back(
            {disc_body(random.uniform(0.05, 2), Layer::kVirtualObstacles), X_WB});
        continue;
      }
      const double x = random.uniform(0.1, 6);
      Body wall;
      wall.shapes =
          make_prisms(std::vector<Vec2>{{-x, -0.1}, {x, -0.1}, {x, 0.1}, {-x, 0.1}}, 0, 1).value();
      wall.layer = Layer::kVirtualObstacles;
      model.obstacles.push_back({wall, X_WB});
    }
    const Snapshot world(model);
    for (int ray = 0; ray < 40; ++ray) {
      const Vec2 p{random.uniform(-60, 60), random.uniform(-60, 60)};
      // Now and then along the axes of the grid.
      const int quarter = ray / 4;
      const double bearing = ray % 4 == 0 ? kPi / 2 * quarter : random.uniform(-kPi, kPi);
      const double most_m = ray % 5 == 0 ? kNoHit : random.uniform(0, 120);
      const SinCos turn = sincos(bearing);
      RayHit expected;
      for (std::uint32_t i = 0; i < world.shapes().size(); ++i) {
        const PlacedShape& shape = world.shape(i);
        const Vec2 direction{turn.cos, turn.sin};
        const double range = shape.kind == ShapeKind::kDisc
                                 ? cast_disc(p, direction, shape.centre_W, shape.radius_m)
                                 : cast_polygon(p, direction, world.vertices_W(shape));
        if (range <= most_m && range < expected.range_m) expected = {range, BodyId(shape.body)};
      }
      const RayHit hit = world.cast(p, 0.5, bearing, most_m, kAllLayers, BodyId());
      ASSERT_EQ(hit.body, expected.body) << "field " << seed << " ray " << ray;
      ASSERT_EQ(hit.range_m, expected.range_m) << "field " << seed << " ray " << ray;
      hits += hit.body.valid() ? 1U : 0U;
    }
  }
  EXPECT_GT(hits, 1000U);
}

TEST(Snapshot, PlacedInPartsIsTheSameAsRebuilt) {
  WorldModel model;
  const std::array<Vec2, 4> square = {{{0, 0}, {3, 0}, {3, 1}, {0, 1}}};
  for (int i = 0; i < 40; ++i) {
    Body body = disc_body(0.1, Layer::kSimulatedRobots);
    if (i % 2 == 0) body.shapes.push_back(make_prisms(square, 0, 1).value().front());
    if (i % 5 == 0) body.code = i;
    model.robots.push_back(body);
  }
  Snapshot whole(model);
  Snapshot parts(model);
  scatter(whole);
  scatter(parts);
  whole.rebuild();
  const double last_m = parts.place_robots(17, 40);
  parts.index_robots(std::max(last_m, parts.place_robots(0, 17)));
  const auto seen = [](const Snapshot& world) {
    std::vector<std::pair<std::uint32_t, Vec2>> pieces;
    world.for_each_near({0, 0}, 100, [&](const ShapePiece& piece) {
      pieces.emplace_back(piece.shape, piece.centre_W);
      for (std::uint32_t k = 0; k < piece.vertex_count; ++k) {
        pieces.emplace_back(k, world.vertices_W()[piece.first_vertex + k]);
        pieces.emplace_back(k, world.normals_W()[piece.first_vertex + k]);
      }
    });
    return pieces;
  };
  EXPECT_EQ(seen(parts), seen(whole));
  EXPECT_GT(seen(whole).size(), 100U);
  EXPECT_EQ(parts.landmarks().size(), whole.landmarks().size());
}

TEST(Snapshot, KnowsSineAndCosineOfEachYaw) {
  const WorldModel model = tube_and_robots();
  Snapshot world(model);
  world.set_robot(RobotId(1), {{2, 0, 1.3}, {}, true});
  EXPECT_EQ(world.turn_WR(RobotId(1)), sincos(1.3));
  world.set_robot(RobotId(1), {{2, 0, -0.7}, {}, true}, sincos(-0.7));
  EXPECT_EQ(world.turn_WR(RobotId(1)), sincos(-0.7));
  EXPECT_EQ(world.turn_WR(RobotId(0)), sincos(0));
}

TEST(Snapshot, AnotherBodyCountsFromTheNextRebuild) {
  WorldModel model = tube_and_robots();
  Snapshot world(model);
  world.set_robot(RobotId(0), {{0, 3, 0}, {}, true});
  world.set_robot(RobotId(1), {{2, 0, 0}, {}, true});
  world.rebuild();
  const auto range_m = [&] { return world.cast({0, 0}, 0.05, 0, 8, kAllLayers, BodyId()).range_m; };
  EXPECT_NEAR(range_m(), 2 - 0.165, 1e-9);
  model.robots[1] = scaled(model.robots[1], 2).value();
  world.body_changed(RobotId(1));
  world.rebuild();
  EXPECT_NEAR(range_m(), 2 - 0.33, 1e-9);
}

TEST(ShapeGrid, LeavesOutWhatIsNowhere) {
  std::vector<ShapePiece> pieces(3);
  for (std::uint32_t i = 0; i < 3; ++i) pieces[i].shape = i;
  pieces[1].pieces = 0;
  pieces[1].centre_W = {1e12, 0};  // would make the cells as large as the world
  ShapeGrid grid;
  grid.build(pieces, 1);
  std::vector<std::uint32_t> found;
  grid.for_each_near({0, 0}, 1e13, [&](const ShapePiece& piece) { found.push_back(piece.shape); });
  EXPECT_EQ(found, (std::vector<std::uint32_t>{0, 2}));
  for (ShapePiece& piece : pieces) piece.pieces = 0;
  grid.build(pieces, 1);
  grid.for_each_near({0, 0}, 1e13, [&](const ShapePiece&) { FAIL() << "nothing is there"; });
}

// Building visits all cells, in each step.
TEST(ShapeGrid, FewPiecesHaveFewCellsHoweverFarApartTheyAre) {
  const auto cells = [](std::initializer_list<Vec2> places) {
    std::vector<ShapePiece> pieces;
    for (const Vec2 p : places) pieces.emplace_back().centre_W = p;
    ShapeGrid grid;
    grid.build(pieces, 2);
    const CellBlock all = grid.cells_near({0, 0}, 1e9);
    return (all.x1 + 1) * (all.y1 + 1);
  };
  EXPECT_LE(cells({{0, 0}, {10, 0}, {10, 10}}), 36);
  EXPECT_LE(cells({{0, 0}, {3000, 0}, {3000, 3000}}), 3 * 3 * 64);
  EXPECT_LE(cells({{0, 0}, {1e7, 0}, {-1e7, 0.5}}), 3 * 3 * 64);
  EXPECT_LE(cells({{0, 0}, {0, 1e7}}), 2 * 3 * 64);
}

// Few pieces that are far apart give cells much larger than a crowd does; they do not make the
// parts of a ray in that crowd longer.
TEST(Snapshot, ARayInACrowdIsInShortPartsHoweverFarTheRobotsAre) {
  WorldModel model = tube_and_robots();
  for (int i = 0; i < 2000; ++i) {
    model.obstacles.push_back(model.obstacles.front());
    model.obstacles.back().X_WB = {0.5 * (i % 50), 0.5 * (i / 50), 0};
  }
  Snapshot world(model);
  world.set_robot(RobotId(0), {{0, 3, 0}, {}, true});
  world.set_robot(RobotId(1), {{2, 0, 0}, {}, true});
  world.rebuild();
  EXPECT_LT(world.first_part_m(), 3);
  world.set_robot(RobotId(0), {{-3e4, 0, 0}, {}, true});
  world.set_robot(RobotId(1), {{0, 3e4, 0}, {}, true});
  world.rebuild();
  EXPECT_LT(world.first_part_m(), 3);
}

TEST(ShapeGrid, FindsWhatALinearSearchFinds) {
  RandomStream random(2, 7, 1, 8);
  for (int world = 0; world < 50; ++world) {
    // Every second world has its pieces so far apart that the cells grow.
    const double scale = world % 2 == 0 ? 1 : random.uniform(1, 1000);
    std::vector<ShapePiece> pieces;
    for (std::uint32_t i = 0; i < 200; ++i) {
      ShapePiece piece;
      piece.centre_W = scale * Vec2{random.uniform(-20, 20), random.uniform(-3, 3)};
      piece.radius_m = static_cast<float>(random.uniform(0, 2));
      piece.shape = i;
      pieces.push_back(piece);
    }
    ShapeGrid grid;
    grid.build(pieces, 1.5);
    for (int query = 0; query < 20; ++query) {
      const Vec2 p = scale * Vec2{random.uniform(-25, 25), random.uniform(-5, 5)};
      const double radius = scale * random.uniform(0, 6);
      std::vector<std::uint32_t> expected;
      for (const ShapePiece& piece : pieces) {
        const double reach = radius + static_cast<double>(piece.radius_m);
        if (squared_norm(piece.centre_W - p) <= reach * reach) expected.push_back(piece.shape);
      }
      std::vector<std::uint32_t> found;
      grid.for_each_near(p, radius, [&](const ShapePiece& piece) { found.push_back(piece.shape); });
      std::sort(found.begin(), found.end());
      ASSERT_EQ(found, expected);
    }
  }
}

TEST(Cover, HoldsTheShapeInSmallDiscs) {
  RandomStream random(3, 7, 1, 8);
  for (int i = 0; i < 50; ++i) {
    const double x = random.uniform(0.05, 40);
    const double y = random.uniform(0.05, 8);
    const std::vector<Vec2> outline = {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
    const Shape shape = make_prisms(outline, 0, 1).value().front();
    const auto discs = cover(shape, 1.0);
    for (const CoverDisc& disc : discs) ASSERT_LE(disc.radius_m, 1.0);
    for (int k = 0; k < 200; ++k) {
      const Vec2 p{random.uniform(-x, x), random.uniform(-y, y)};
      const bool held = std::any_of(discs.begin(), discs.end(), [&](const CoverDisc& disc) {
        return squared_norm(p - disc.centre_B) <= disc.radius_m * disc.radius_m * (1 + 1e-9);
      });
      ASSERT_TRUE(held) << x << " " << y << ": " << p.x << ", " << p.y;
    }
  }
}

TEST(CastPolygon, IsExactOnASquare) {
  const std::array<Vec2, 4> square = {{{1, -1}, {3, -1}, {3, 1}, {1, 1}}};
  EXPECT_DOUBLE_EQ(cast_polygon({0, 0}, {1, 0}, square), 1);
  EXPECT_DOUBLE_EQ(cast_polygon({2, 0}, {1, 0}, square), 0);
  EXPECT_EQ(cast_polygon({0, 0}, {-1, 0}, square), kNoHit);
  EXPECT_EQ(cast_polygon({0, 2}, {1, 0}, square), kNoHit);
}

TEST(MakePrisms, SplitsWhatIsNotConvex) {
  const std::array<Vec2, 6> corner = {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}};
  const auto shapes = make_prisms(corner, 0, 1);
  ASSERT_TRUE(shapes);
  double total_m2 = 0;
  for (const Shape& shape : *shapes) total_m2 += area(*shape.polygon);
  EXPECT_GE(shapes->size(), 2U);
  EXPECT_NEAR(total_m2, 3, 1e-9);
}

TEST(MakePrisms, RefusesWhatIsNoPolygon) {
  const std::array<Vec2, 4> bow_tie = {{{0, 0}, {1, 1}, {1, 0}, {0, 1}}};
  EXPECT_NE(make_prisms(bow_tie, 0, 1).error().message.find("cross"), std::string::npos);
  const std::array<Vec2, 3> triangle = {{{0, 0}, {1, 0}, {0, 1}}};
  EXPECT_NE(make_prisms(triangle, 1, 1).error().message.find("from low to high"),
            std::string::npos);
}

}  // namespace
}  // namespace rave::world
