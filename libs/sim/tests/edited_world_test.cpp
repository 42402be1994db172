// SPDX-License-Identifier: Apache-2.0
// After any changes of obstacles a snapshot shows what one shows that is made anew, and what a loop
// over all bodies finds.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../src/listed_fan.hpp"
#include "../src/obstacle_journal.hpp"
#include "rave/base/random.hpp"
#include "rave/math/scalar.hpp"
#include "rave/sim/range_engine.hpp"

namespace rave::sim::testing {
namespace {

constexpr double kEditedSide_m = 12;
constexpr std::uint32_t kEditedRobots = 12;

world::Body body_of(RandomStream& random) {
  world::Body body;
  if (random.bits() % 3 == 0) {
    body.shapes.push_back(
        world::make_disc({random.uniform(-0.2, 0.2), 0}, random.uniform(0.1, 0.6), 0, 1).value());
  } else {
    const double x_m = random.bits() % 4 == 0 ? random.uniform(1, 4) : random.uniform(0.1, 0.6);
    const double y_m = random.uniform(0.1, 0.4);
    body.shapes = world::make_prisms(
                      std::vector<Vec2>{{-x_m, -y_m}, {x_m, -y_m}, {x_m, y_m}, {-x_m, y_m}}, 0, 1)
                      .value();
  }
  if (random.bits() % 4 == 0) body.code = static_cast<std::int32_t>(random.bits() % 100);
  return body;
}

Pose2 pose_of(RandomStream& random) {
  return {random.uniform(0, kEditedSide_m), random.uniform(0, kEditedSide_m),
          random.uniform(-3, 3)};
}

/// A world that changes, and a snapshot that follows it.
struct Scene {
  explicit Scene(std::uint32_t number) : random(41, number, 0, 0) {
    for (int i = 0; i < 8; ++i) model.obstacles.push_back({body_of(random), pose_of(random)});
    for (std::uint32_t r = 0; r < kEditedRobots; ++r) {
      model.robots.push_back(body_of(random));
      model.robots.back().layer = Layer::kSimulatedRobots;
      poses.push_back(pose_of(random));
    }
    live = std::make_unique<world::Snapshot>(model);
    place(*live);
  }

  void place(world::Snapshot& world) const {
    for (std::uint32_t r = 0; r < kEditedRobots; ++r)
      world.set_robot(RobotId(r), {poses[r], {}, true});
    world.rebuild();
  }

  /// Adds, moves or removes one at random; now and then a robot gets another body.
  void change() {
    const std::uint32_t what = random.bits() % 8;
    if (what < 3 || model.obstacle_count() == 0) {
      model.added.push_back({body_of(random), pose_of(random), false});
      live->obstacle_added();
      const std::uint32_t id = model.obstacle_id(model.obstacle_count() - 1);
      live->set_obstacle(BodyId(id), model.added.back().X_WB, true);
    } else if (what < 7) {
      const std::uint32_t id = model.obstacle_id(random.bits() % model.obstacle_count());
      world::Obstacle& obstacle = *model.obstacle(id);
      if (what == 3) obstacle.removed = true;
      if (what != 3) obstacle.X_WB = pose_of(random);
      live->set_obstacle(BodyId(id), obstacle.X_WB, !obstacle.removed);
    } else {
      const std::uint32_t r = random.bits() % kEditedRobots;
      model.robots[r] = world::scaled(model.robots[r], random.uniform(0.6, 1.6)).value();
      live->body_changed(RobotId(r));
    }
    live->index_obstacles();
  }

  /// By a loop over all bodies.
  [[nodiscard]] RayHit nearest(Vec2 p_W, double bearing_rad, std::uint32_t skip) const {
    const SinCos turn = sincos(bearing_rad);
    RayHit hit;
    for (std::uint32_t id = 0; id < model.body_count(); ++id) {
      const world::Obstacle* const obstacle = model.obstacle(id);
      if (id == skip || (obstacle != nullptr && obstacle->removed)) continue;
      const Pose2 X_WB = obstacle != nullptr ? obstacle->X_WB : poses[id - model.obstacles.size()];
      const SinCos of_body = sincos(X_WB.yaw);
      for (const world::Shape& shape : model.body(id).shapes) {
        std::vector<Vec2> corners;
        for (const Vec2 v : shape.vertices()) {
          corners.push_back(X_WB.position() + rotate(of_body, v));
        }
        const double range_m =
            corners.empty()
                ? world::cast_disc(p_W, {turn.cos, turn.sin},
                                   X_WB.position() + rotate(of_body, shape.centre), shape.radius_m)
                : world::cast_polygon(p_W, {turn.cos, turn.sin}, corners);
        if (range_m < hit.range_m) hit = {range_m, BodyId(id)};
      }
    }
    return hit;
  }

  /// How many bodies that are somewhere carry a code.
  [[nodiscard]] std::size_t coded() const {
    std::size_t count = 0;
    for (std::uint32_t id = 0; id < model.body_count(); ++id) {
      const world::Obstacle* const obstacle = model.obstacle(id);
      const bool there = obstacle == nullptr || !obstacle->removed;
      if (there && model.body(id).code) ++count;
    }
    return count;
  }

  RandomStream random;
  world::WorldModel model;
  std::vector<Pose2> poses;
  std::unique_ptr<world::Snapshot> live;
};

FanTable fan_all_around() {
  constexpr std::uint32_t kRays = 40;
  std::array<double, kRays> bearings_rad{};
  for (std::uint32_t i = 0; i < kRays; ++i) bearings_rad[i] = 2 * kPi * (double{1} * i / kRays);
  FanQuery query;
  query.ray_count = kRays;
  query.bearings_rad = bearings_rad.data();
  query.range_max_m = 6;
  return FanTable::make(query, kAllLayers);
}

struct Readings {
  std::array<float, 40> ranges_m{};
  std::array<std::uint32_t, 40> bodies{};
  bool operator==(const Readings&) const = default;
};

TEST(EditedWorld, RangesAreThoseOfAWorldMadeAnew) {
  const FanTable fan = fan_all_around();
  FanScratch scratch;
  FanScratch listed_scratch;
  BlockScratch block;
  for (std::uint32_t number = 0; number < 40; ++number) {
    Scene scene(number);
    NearLists lists;
    std::vector<RobotId> owners;
    std::vector<SensorPlace> places;
    std::vector<Vec2> places_W;
    for (std::uint32_t r = 0; r < kEditedRobots; ++r) {
      owners.emplace_back(r);
      places.push_back(sensor_place(scene.poses[r], {0.1, 0, 0.2}));
      places_W.push_back(places.back().p_WS);
    }
    for (int k = 0; k < 60; ++k) {
      if (k % 2 == 0) scene.change();
      scene.place(*scene.live);
      world::Snapshot anew(scene.model);
      scene.place(anew);
      if (!lists.hold(*scene.live, places_W)) {
        list_near(*scene.live, fan, 0.2, owners, places_W, 0.4, scratch, lists);
      }
      ListedFans fans(*scene.live, fan, lists, places, listed_scratch, block);
      for (std::uint32_t r = 0; r < kEditedRobots; ++r) {
        const BodyId own = anew.body_of(RobotId(r));
        Readings listed, live, fresh;
        fans.read(r, listed.ranges_m, listed.bodies);
        cast_fan(*scene.live, fan, places[r], 0.2, own, scratch, live.ranges_m, live.bodies);
        cast_fan(anew, fan, places[r], 0.2, own, scratch, fresh.ranges_m, fresh.bodies);
        ASSERT_EQ(live, fresh) << "world " << number << ", change " << k << ", robot " << r;
        ASSERT_EQ(listed, fresh) << "world " << number << ", change " << k << ", robot " << r;
      }
    }
  }
}

TEST(EditedWorld, RaysMeetWhatALoopOverAllBodiesFinds) {
  for (std::uint32_t number = 0; number < 20; ++number) {
    Scene scene(100 + number);
    for (int k = 0; k < 60; ++k) {
      scene.change();
      scene.place(*scene.live);
      for (int i = 0; i < 20; ++i) {
        const Pose2 from = pose_of(scene.random);
        const BodyId own = scene.live->body_of(RobotId(scene.random.bits() % kEditedRobots));
        const RayHit hit = scene.live->cast(from.position(), 0.5, from.yaw, 100, kAllLayers, own);
        const RayHit expected = scene.nearest(from.position(), from.yaw, own.value());
        ASSERT_EQ(hit.range_m, expected.range_m) << "world " << number << ", change " << k;
        if (hit.range_m > 0) {
          ASSERT_EQ(hit.body, expected.body);
        }
      }
    }
  }
}

TEST(EditedWorld, LandmarksAndPiecesFollow) {
  for (std::uint32_t number = 0; number < 20; ++number) {
    Scene scene(200 + number);
    for (int k = 0; k < 60; ++k) {
      scene.change();
      scene.place(*scene.live);
      world::Snapshot anew(scene.model);
      scene.place(anew);
      ASSERT_EQ(scene.live->landmarks().size(), anew.landmarks().size());
      ASSERT_EQ(scene.live->landmarks().size(), scene.coded());
      for (std::size_t i = 0; i < anew.landmarks().size(); ++i) {
        EXPECT_EQ(scene.live->landmarks()[i].body, anew.landmarks()[i].body);
        EXPECT_EQ(scene.live->landmarks()[i].p_WL, anew.landmarks()[i].p_WL);
      }
      ASSERT_EQ(scene.live->standing().size(), anew.standing().size());
      for (std::uint32_t i = 0; i < anew.standing().size(); ++i) {
        const world::ShapePiece& piece = scene.live->standing().piece(i);
        ASSERT_EQ(scene.live->pieces()[piece.index].centre_W, piece.centre_W);
        ASSERT_EQ(scene.live->pieces()[piece.index].body, piece.body);
      }
    }
    // All that came go again, and the rest is as if they had never been.
    scene.model.added.clear();
    scene.live->added_dropped();
    scene.live->index_obstacles();
    scene.place(*scene.live);
    world::Snapshot anew(scene.model);
    scene.place(anew);
    ASSERT_EQ(scene.live->shapes().size(), anew.shapes().size());
    ASSERT_EQ(scene.live->standing().size(), anew.standing().size());
    ASSERT_EQ(scene.live->moving().size(), anew.moving().size());
    for (int k = 0; k < 20; ++k) {
      scene.change();
      scene.place(*scene.live);
      const Pose2 from = pose_of(scene.random);
      EXPECT_EQ(scene.live->cast(from.position(), 0.5, from.yaw, 100, kAllLayers, BodyId()).range_m,
                scene.nearest(from.position(), from.yaw, BodyId::kNone).range_m);
    }
  }
}

TEST(ObstacleJournal, ShowsAnyRevisionThatItRemembers) {
  world::WorldModel model;
  world::Body post;
  post.shapes.push_back(world::make_disc({}, 0.1, 0, 1).value());
  model.obstacles.push_back({post, {0, 0, 0}});
  ObstacleJournal journal;
  world::Snapshot early(model);
  std::uint64_t shown = journal.revision();
  EXPECT_EQ(journal.revision_at({-1}), 0U);
  for (int k = 1; k <= 10; ++k) {
    const Pose2 before = model.obstacles[0].X_WB;
    model.obstacles[0].X_WB.x = k;
    journal.add({{10 * k}, BodyId(0), {before, true}, {model.obstacles[0].X_WB, true}});
  }
  EXPECT_EQ(journal.revision_at({9}), 0U);
  EXPECT_EQ(journal.revision_at({10}), 1U);
  EXPECT_EQ(journal.revision_at({99}), 9U);
  EXPECT_EQ(journal.revision_at({1000}), 10U);
  const auto x_at = [&](std::int64_t ns) {
    journal.show(early, shown, journal.revision_at({ns}));
    EXPECT_EQ(shown, journal.revision_at({ns}));
    return early.obstacle_pose(BodyId(0)).x;
  };
  EXPECT_EQ(x_at(35), 3);
  EXPECT_EQ(x_at(80), 8);
  EXPECT_EQ(x_at(15), 1);
  journal.forget_before({60});
  EXPECT_EQ(journal.revision(), 10U);
  EXPECT_EQ(x_at(75), 7) << "although it has missed the fifth";
  EXPECT_EQ(x_at(60), 6);
  EXPECT_EQ(x_at(1), 5) << "as far back as is remembered";
  EXPECT_EQ(x_at(100), 10);
}

}  // namespace
}  // namespace rave::sim::testing
