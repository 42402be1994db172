// SPDX-License-Identifier: Apache-2.0
#include "rave/drawing/drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outlines.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/engine.hpp"
#include "robot_drawing.hpp"

namespace rave::drawing {
namespace {

using report::Kind;
using report::Picture;

/// Leaves what stands and senses and needs no device, program or wait.
void keep_what_can_be_drawn(const config::AnyFile& input, runtime::BuiltScenario& built,
                            std::vector<std::string>& unplaced) {
  sim::EngineSpec& spec = built.spec;
  std::vector<sim::RobotSpec> robots;
  std::vector<world::Body> bodies;
  for (std::size_t r = 0; r < spec.robots.size(); ++r) {
    const config::ExpandedRobot& robot = input.scenario.robots[r];
    const bool scattered = input.scenario.group_of(robot).scatter.has_value();
    if (!spec.types[spec.robots[r].type].simulated && !robot.pose && !scattered) {
      unplaced.push_back(robot.name);
      continue;
    }
    robots.push_back(std::move(spec.robots[r]));
    bodies.push_back(std::move(spec.world.robots[r]));
  }
  spec.robots = std::move(robots);
  spec.world.robots = std::move(bodies);
  for (sim::RobotType& type : spec.types) {
    keep_virtual_sensors(type);
    for (sim::SensorSpec& sensor : type.sensors) {
      // One step is drawn, so all sense in it, and without noise.
      sensor.phase_steps = 0;
      sensor.processing = {};
    }
  }
  // One step of a few robots: a pool of threads would take longer to start.
  spec.threads = 1;
  spec.history = {};
  spec.live_clock = nullptr;
}

Kind robot_kind(const world::Body& body) {
  return body.layer == Layer::kRealRobots ? Kind::kRecordedRobot : Kind::kSimulatedRobot;
}

Kind kind_of_id(const world::WorldModel& world, std::uint32_t id) {
  return id < world.obstacles.size() ? kind_of(world.body(id)) : robot_kind(world.body(id));
}

/// The rays of one range sensor as it reads at the start.
void add_rays(const sim::Engine& engine, RobotId robot, std::uint32_t index, Picture& picture) {
  const sim::SensorSample sample = engine.sensor(robot, index);
  const SensorInfo& info = *sample.info;
  // What a cone met lies anywhere on an arc.
  const bool is_cone = info.cone_rad > 0;
  if (info.kind != ReadingKind::kRanges || info.bearings_rad == nullptr) return;
  const Pose2 X_WS = compose(engine.true_pose(robot), info.X_RS);
  const auto* const ranges_m = static_cast<const float*>(sample.records);
  for (std::uint32_t i = 0; i < sample.header->count; ++i) {
    // No return is +infinity: the ray is drawn to the end of the range.
    const double range_m = std::min(static_cast<double>(ranges_m[i]), info.range_max_m);
    report::PictureHit hit{X_WS.position(), {}, std::nullopt};
    hit.to_W = transform(X_WS, range_m * rotate(info.bearings_rad[i], {1, 0}));
    if (!is_cone && i < sample.bodies.size() && sample.bodies[i] != BodyId::kNone) {
      hit.kind = kind_of_id(engine.spec().world, sample.bodies[i]);
    }
    picture.instant->hits.push_back(hit);
  }
}

Status add_robots(sim::EngineSpec spec, Picture& picture) {
  RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(spec)));
  // Sensors read in a step; before the first one they have no sample.
  RAVE_TRY(engine->step());
  const world::WorldModel& world = engine->spec().world;
  for (std::uint32_t r = 0; r < world.robots.size(); ++r) {
    add_robot(world.robots[r], engine->true_pose(RobotId(r)), robot_kind(world.robots[r]), picture);
    const auto& sensors = engine->spec().types[engine->spec().robots[r].type].sensors;
    for (std::uint32_t s = 0; s < sensors.size(); ++s) add_rays(*engine, RobotId(r), s, picture);
  }
  return {};
}

Result<Picture> draw_world(const config::AnyFile& input, runtime::BuiltScenario built) {
  Picture picture;
  std::vector<std::string> unplaced;
  keep_what_can_be_drawn(input, built, unplaced);
  if (input.kind == config::FileKind::kWorld) {
    built.spec.robots.clear();
    built.spec.world.robots.clear();
  }
  const bool has_robots = !built.spec.robots.empty();
  picture.title = input.kind == config::FileKind::kWorld ? input.path.stem().string()
                                                         : input.scenario.scenario.name.value;
  picture.subtitle =
      input.kind == config::FileKind::kScenario ? input.scenario.scenario.description : "";
  for (const world::Obstacle& obstacle : built.spec.world.obstacles) {
    const bool from_map = !input.scenario.world.maps.empty() && !obstacle.body.code &&
                          obstacle.body.layer == Layer::kMappedReal;
    std::string label = obstacle.body.code ? std::to_string(*obstacle.body.code)
                        : from_map         ? std::string()
                                           : obstacle.body.name;
    for (const world::Shape& shape : obstacle.body.shapes) {
      picture.bodies.push_back({outline_of(shape, obstacle.X_WB), kind_of(obstacle.body),
                                std::move(label), obstacle.body.colour});
      // A body of several shapes has its name once.
      label.clear();
    }
  }
  picture.instant.emplace();
  if (has_robots) RAVE_TRY(add_robots(std::move(built.spec), picture));
  picture.instant->heading = has_robots
                                 ? "Robots at their start, with the readings of their range sensors"
                                 : "Static bodies";
  if (!unplaced.empty()) {
    picture.caption.push_back(fmt::format("Not shown, because their poses come from devices: {}.",
                                          fmt::join(unplaced, ", ")));
  }
  return picture;
}

}  // namespace

Status draw(const config::AnyFile& input, runtime::BuiltScenario built,
            const std::filesystem::path& path) {
  RAVE_TRY_ASSIGN(const Picture picture, input.kind == config::FileKind::kRobot
                                             ? draw_one_robot(input, std::move(built))
                                             : draw_world(input, std::move(built)));
  const std::string ending = path.extension().string();
  if (ending == ".svg") return report::write_svg(picture, path);
  if (ending == ".png") return report::write_png(picture, path);
  return fail(ErrorCode::kInvalidArgument,
              "`{}`: expected a file name that ends in `.svg` or `.png`", path.string());
}

}  // namespace rave::drawing
