// SPDX-License-Identifier: Apache-2.0
// Obstacles that come, move and go through the bytes that other processes get.
#include "rave/protocol/obstacle_messages.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "rave/bus/sequence.hpp"
#include "rave/bus/validate.hpp"
#include "rave/bus_testing/messages.hpp"
#include "rave/sim/obstacle_history.hpp"

namespace rave::lock_step::testing {
namespace {

using Kind = sim::ObstacleChange::Kind;
using bus::testing::Decoded;
using bus::testing::encode;

std::string hex(double value) { return fmt::format("{:x} ", std::bit_cast<std::uint64_t>(value)); }

std::string text_of(const sim::ObstacleChange& change) {
  const world::Body& body = change.body;
  std::string text =
      fmt::format("{} {} {} {} {} {} {} ", static_cast<int>(change.kind), change.id.value(),
                  change.name, change.asked, body.name, static_cast<int>(body.layer), body.colour);
  if (body.code) text += fmt::format("code {} ", *body.code);
  for (const double value :
       {change.X_WB.x, change.X_WB.y, change.X_WB.yaw, body.code_z0_m, body.code_z1_m}) {
    text += hex(value);
  }
  for (const world::Shape& shape : body.shapes) {
    text += fmt::format("shape {} ", static_cast<int>(shape.kind));
    for (const double value :
         {shape.centre.x, shape.centre.y, shape.radius_m, shape.z0_m, shape.z1_m}) {
      text += hex(value);
    }
    for (const Vec2 corner : shape.vertices()) text += hex(corner.x) + hex(corner.y);
  }
  return text;
}

sim::ObstacleChange addition(std::vector<world::Shape> shapes) {
  sim::ObstacleChange change;
  change.id = BodyId(7);
  change.name = "bale";
  change.X_WB = {1.25, -0.0, 0.3};
  change.body.name = change.name;
  change.body.layer = Layer::kMappedReal;
  change.body.code = -4;
  change.body.code_z0_m = 0.1;
  change.body.code_z1_m = 0.4;
  change.body.colour = "#00ff7f";
  change.body.shapes = std::move(shapes);
  change.asked = R"({"add_obstacle": {"name": "bale", "disc_radius_m": 1}})";
  return change;
}

/// Corners on a circle at random angles, as files and people may have them.
std::vector<Vec2> ring(std::mt19937& chance, std::size_t corners, double radius_m) {
  std::uniform_real_distribution<double> share(0.2, 0.8);
  const Vec2 middle{share(chance) * radius_m, -share(chance) * radius_m};
  std::vector<Vec2> ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle =
        (static_cast<double>(i) + share(chance)) * 6.283185307 / static_cast<double>(corners);
    ring.push_back({middle.x + radius_m * std::cos(angle), middle.y + radius_m * std::sin(angle)});
  }
  return ring;
}

/// Through the bytes of a message.
Result<sim::ObstacleChange> through(const sim::ObstacleChange& change) {
  ObstacleParts parts;
  RAVE_TRY(parts.fill(std::span(&change, 1)));
  bus::Obstacle wire{};
  wire.writer = 1;
  wire.id = change.id.value();
  wire.revision = 1;
  wire.stands = parts.changes().front();
  Decoded<bus::Obstacle> decoded;
  if (!decoded.decode(encode(wire))) return fail(ErrorCode::kParse, "no message");
  RAVE_TRY(bus::validate(decoded.sample()));
  return read_obstacle(decoded.sample().stands);
}

TEST(ObstacleMessages, BodiesComeThroughToTheBit) {
  std::mt19937 chance(5);
  for (std::size_t corners = 3; corners <= 64; ++corners) {
    for (const double radius_m : {0.01, 0.7, 5000.0}) {
      auto shapes = world::make_prisms(ring(chance, corners, radius_m), -0.25, 1e300);
      ASSERT_TRUE(shapes) << shapes.error().message;
      shapes->push_back(*world::make_disc({0.1, 0.2}, 0.3, 0, 1));
      const sim::ObstacleChange change = addition(*std::move(shapes));
      ASSERT_TRUE(check_fits(change));
      const auto again = through(change);
      ASSERT_TRUE(again) << again.error().message;
      ASSERT_EQ(text_of(*again), text_of(change));
    }
  }
}

TEST(ObstacleMessages, AShapeThatWasCutIntoConvexPiecesComesThrough) {
  const std::vector<Vec2> ell = {{0, 0}, {2, 0}, {2, 0.5}, {0.5, 0.5}, {0.5, 2}, {0, 2}};
  auto shapes = world::make_prisms(ell, 0, 1);
  ASSERT_TRUE(shapes);
  ASSERT_GE(shapes->size(), 2U);
  const sim::ObstacleChange change = addition(*std::move(shapes));
  const auto again = through(change);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(text_of(*again), text_of(change));
}

TEST(ObstacleMessages, MovesAndRemovalsComeThrough) {
  sim::ObstacleChange change;
  change.kind = Kind::kMove;
  change.id = BodyId(3);
  change.name = "post";
  change.X_WB = {1e-300, -1e7, 1e6};
  auto again = through(change);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(text_of(*again), text_of(change));
  change.kind = Kind::kRemove;
  change.X_WB = {};
  again = through(change);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ(text_of(*again), text_of(change));
}

TEST(ObstacleMessages, AMessageLeavesNothingOfTheOneBefore) {
  auto shapes = world::make_prisms(std::vector<Vec2>{{0, 0}, {1, 0}, {0, 1}}, 0, 1);
  ObstacleParts parts;
  ASSERT_TRUE(parts.fill(std::vector{addition(*shapes), addition(*shapes)}));
  EXPECT_EQ(parts.changes().size(), 2U);
  ASSERT_TRUE(parts.fill({}));
  EXPECT_TRUE(parts.changes().empty());
}

std::string polygon_refusal(const std::vector<Vec2>& corners) {
  std::vector<double> x;
  std::vector<double> y;
  for (const Vec2 corner : corners) {
    x.push_back(corner.x);
    y.push_back(corner.y);
  }
  rave_wire_BodyShape shape{};
  shape.kind = rave_wire_SHAPE_POLYGON;
  bus::borrow(shape.x_m, x);
  bus::borrow(shape.y_m, y);
  shape.z_max_m = 1;
  std::vector<rave_wire_BodyShape> shapes = {shape};
  rave_wire_ObstacleChange wire{};
  bus::put_text(wire.name, "bale");
  bus::borrow(wire.shapes, shapes);
  const auto read = read_obstacle(wire);
  return read ? "" : read.error().message;
}

TEST(ObstacleMessages, APolygonThatWouldComeOutOtherwiseIsRefused) {
  EXPECT_EQ(polygon_refusal({{0, 0}, {1, 0}, {0, 1}}), "");
  const std::string other =
      "obstacle `bale`, shapes[0]: its corners are not those of a polygon that is strictly convex "
      "and counterclockwise";
  EXPECT_EQ(polygon_refusal({{0, 0}, {0, 1}, {1, 0}}), other) << "clockwise";
  EXPECT_EQ(polygon_refusal({{0, 0}, {0.5, 0}, {1, 0}, {0, 1}}), other) << "on one line";
  EXPECT_NE(polygon_refusal({{0, 0}, {1, 0}, {0.1, 0.1}, {0, 1}}).find("not convex"),
            std::string::npos);
}

TEST(ObstacleMessages, WhatTheBusCannotCarryIsRefused) {
  sim::ObstacleChange change;
  change.kind = Kind::kRemove;
  change.id = BodyId(3);
  change.name = std::string(65, 'n');
  EXPECT_EQ(check_fits(change).error().message,
            "the name of obstacle `" + change.name + "` is too long to be sent to another process");
  change.name = "n";
  change.asked = std::string(4097, 'a');
  EXPECT_FALSE(check_fits(change));
}

TEST(ObstacleHistory, SaysInFewChangesHowObstaclesCameToStand) {
  sim::ObstacleHistory history;
  sim::ObstacleChange change = addition({*world::make_disc({}, 0.3, 0, 1)});
  history.add(change);
  change.kind = Kind::kMove;
  for (int i = 0; i < 1000; ++i) {
    change.X_WB.x = i;
    history.add(change);
  }
  sim::ObstacleChange post;
  post.kind = Kind::kMove;
  post.id = BodyId(0);
  post.name = "post";
  history.add(post);
  post.kind = Kind::kRemove;
  history.add(post);
  ASSERT_EQ(history.changes().size(), 2U);
  EXPECT_EQ(history.count(), 1003U);
  EXPECT_EQ(history.changes()[0].kind, Kind::kAdd);
  EXPECT_EQ(history.changes()[0].X_WB.x, 999);
  EXPECT_TRUE(history.changes()[0].asked.empty());
  EXPECT_EQ(history.changes()[1].kind, Kind::kRemove);
  change.kind = Kind::kRemove;
  history.add(change);
  ASSERT_EQ(history.changes().size(), 3U) << "its number stays taken";
  const sim::ObstacleHistory again(history.changes(), history.count());
  EXPECT_EQ(again.changes().size(), 3U);
  EXPECT_EQ(again.count(), 1004U);
}

}  // namespace
}  // namespace rave::lock_step::testing
