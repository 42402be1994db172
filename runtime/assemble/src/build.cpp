// SPDX-License-Identifier: Apache-2.0
#include "rave/assemble/build.hpp"

#include <algorithm>
#include <cmath>

#include "check_sensors.hpp"
#include "guards.hpp"
#include "places.hpp"
#include "rave/assemble/devices.hpp"
#include "rave/assemble/obstacles.hpp"
#include "rave/assemble/twins.hpp"
#include "rave/config/map_image.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/plugin/keep_loaded.hpp"
#include "rave/sim/virtual_sensor.hpp"
#include "scenario_conductor.hpp"
#include "sees_others.hpp"

namespace rave::runtime {
namespace {

/// What a person should know of a map that gives no obstacle.
std::string no_walls_text(const config::MapFile& file, const config::MapImage& map) {
  const std::string text = fmt::format(
      "map `{}`: none of its {} x {} cells is occupied, so it gives no obstacle; {}",
      file.file.value, map.width, map.height,
      map.raw ? "`mode: raw` takes grey values of 0 to 100 as per cent of occupancy and others as "
                "unknown; most images need `mode: trinary`"
              : "look at `negate`, `mode` and `occupied_thresh`");
  return Error{ErrorCode::kInvalidArgument, text, file.file.where}.text();
}

/// The walls of a map: one box for each rectangle of occupied cells.
Status add_map(const config::MapFile& file, const config::InputFiles& files, BuiltScenario& built) {
  auto map = config::read_map(file.file.value, files);
  if (!map) {
    Error error = std::move(map).error();
    error.message = fmt::format("map `{}`: {}", file.file.value, error.text());
    error.where = file.file.where;
    return tl::unexpected(std::move(error));
  }
  // The frame of a map has its origin at the lower left corner of the image and may be turned, so a
  // box that is parallel to the image becomes a turned body.
  const Pose2 X_WMap{map->origin_x_m, map->origin_y_m, wrap_angle(map->origin_yaw_rad)};
  const std::string stem = std::filesystem::path(file.file.value).stem().string();
  std::size_t number = 0;
  world::WorldModel& world = built.spec.world;
  const std::size_t before = world.obstacles.size();
  for (const config::MapRectangle& r : config::rectangles_of(*map)) {
    world::Obstacle wall;
    wall.body.name = fmt::format("{}-{}", stem, ++number);
    wall.body.layer = layer_of(file.layer);
    const Vec2 middle{(r.min_x_m + r.max_x_m) / 2, (r.min_y_m + r.max_y_m) / 2};
    // The frame of a wall is in its middle, as that of a box in a world file, so the corners below
    // are plus and minus half its sides.
    wall.X_WB = compose(X_WMap, {middle.x, middle.y, 0});
    const double x = (r.max_x_m - r.min_x_m) / 2;
    const double y = (r.max_y_m - r.min_y_m) / 2;
    RAVE_TRY_ASSIGN(wall.body.shapes,
                    world::make_prisms(std::vector<Vec2>{{-x, -y}, {x, -y}, {x, y}, {-x, y}},
                                       file.z_m[0], file.z_m[1]));
    world.obstacles.push_back(std::move(wall));
  }
  if (world.obstacles.size() == before) built.notes.push_back(no_walls_text(file, *map));
  return {};
}

Result<world::Body> make_body(const config::RobotGroup& group) {
  world::Body body;
  const config::BodyFile& file = group.robot.body.value;
  body.colour = file.colour.value_or("");
  double low = 0;
  double high = 0;
  for (const config::ShapeFile& shape : file.shapes) {
    const Pose2 X_BO{shape.centre_m[0], shape.centre_m[1], wrap_angle(deg_to_rad(shape.yaw_deg))};
    auto pieces = shapes_of(shape.outline, X_BO, shape.z_m);
    if (!pieces) {
      return fail_at(group.robot.body.where, ErrorCode::kInvalidArgument, "body of `{}`: {}",
                     group.name.value, pieces.error().message);
    }
    // Without `barcode_z_m` a barcode covers the whole height of the body, from the lowest shape to
    // the top of the highest one.
    low = body.shapes.empty() ? shape.z_m[0] : std::min(low, shape.z_m[0]);
    high = body.shapes.empty() ? shape.z_m[1] : std::max(high, shape.z_m[1]);
    for (world::Shape& piece : *pieces) body.shapes.push_back(std::move(piece));
  }
  if (file.barcode) {
    const config::HeightRange code_z_m = file.barcode_z_m.value_or(config::HeightRange{low, high});
    body.code = *file.barcode;
    body.code_z0_m = code_z_m[0];
    body.code_z1_m = code_z_m[1];
  }
  return body;
}

/// Notes unusual settings that are nevertheless permitted, such as sensors inside the body (#30).
void note_oddities(const config::RobotGroup& group, const world::Body& body, BuiltScenario& built) {
  for (const config::SensorFile& sensor : group.robot.sensors) {
    const config::MountFile& mount = sensor.mount.value;
    for (const world::Shape& shape : body.shapes) {
      // A mount above or below the shape is usual: a camera on a mast, a bumper under the deck.
      if (shape.polygon || mount.z_m < shape.z0_m || mount.z_m > shape.z1_m) continue;
      const Vec2 off{mount.x_m - shape.centre.x, mount.y_m - shape.centre.y};
      // Farther than two radii from the middle of a disc, a mount is probably a mistake in the unit
      // or sign, but a long boom is possible. So this is a note, not an error.
      if (squared_norm(off) > 4 * shape.radius_m * shape.radius_m) {
        built.notes.push_back(fmt::format(
            "sensor `{}` of `{}` is mounted {:.2f} m from the middle of a body of {:.2f} m radius",
            sensor.name.value, group.name.value, std::sqrt(squared_norm(off)), shape.radius_m));
      }
    }
  }
}

/// By group: whether this process runs a robot of it.
std::vector<std::uint8_t> groups_here(const config::ExpandedScenario& scenario,
                                      const BuildOptions& options) {
  std::vector<std::uint8_t> here(scenario.groups.size(), options.local ? 0 : 1);
  if (!options.local) return here;
  for (const RobotId robot : *options.local) here[scenario.robots[robot.value()].group] = 1;
  return here;
}

/// Clears all pointers into the memory of plug-ins.
/// Drivers of other hosts are loaded only to check their parameters and to learn what their sensors
/// give. Their catalogue and its libraries end soon after, so no pointer into them may stay.
void let_go_of_plugins(sim::RobotType& type) {
  for (sim::DeviceSpec& device : type.devices) device.ops = nullptr;
  for (sim::SensorSpec& sensor : type.sensors) {
    sensor.virtual_ops = nullptr;
    sensor.hardware_ops = nullptr;
    if (!sensor.hybrid) continue;
    sensor.hybrid->ops = nullptr;
    sensor.hybrid->virtual_ops = nullptr;
  }
  for (sim::ControllerSpec& controller : type.controllers) {
    controller.ops = nullptr;
    controller.param_specs = {};
  }
  for (sim::ActuatorSpec& actuator : type.actuators) {
    actuator.virtual_ops = nullptr;
    actuator.hardware_ops = nullptr;
    actuator.param_specs = {};
  }
  for (sim::TransmitterSpec& transmitter : type.transmitters) transmitter.ops = nullptr;
  for (sim::CommunicatorSpec& communicator : type.communicators) communicator.ops = nullptr;
  if (!type.program) return;
  type.program->ops = nullptr;
  type.program->param_specs = {};
  type.program->isolate = nullptr;
}

Status add_groups(const config::ExpandedScenario& scenario, plugin::Catalogue& catalogue,
                  const BuildOptions& options, BuiltScenario& built,
                  std::vector<world::Body>& bodies) {
  const std::vector<std::uint8_t> here = groups_here(scenario, options);
  for (const config::RobotGroup& group : scenario.groups) {
    // Each group makes one type, in order, so the number of types made so far is the index of the
    // group. Types of twins follow after all of these.
    const bool others = here[built.spec.types.size()] == 0 && options.others != nullptr;
    plugin::Catalogue& drivers = others ? *options.others : catalogue;
    RAVE_TRY_ASSIGN(sim::RobotType type, make_type({scenario, drivers, options, built}, group));
    RAVE_TRY_ASSIGN(auto body, make_body(group));
    // The layer decides which virtual sensors see the robot, so it follows from the drivers and is
    // no key of the robot file.
    body.layer = type.simulated ? Layer::kSimulatedRobots : Layer::kRealRobots;
    note_oddities(group, body, built);
    bodies.push_back(std::move(body));
    built.sees.push_back(sees_others(type) ? 1 : 0);
    built.spec.types.push_back(std::move(type));
  }
  return {};
}

}  // namespace

bool needs_manager(const BuiltScenario& built) {
  return std::any_of(built.sees.begin(), built.sees.end(), [](auto sees) { return sees != 0; });
}

plugin::Stamp host_stamp() {
  return plugin::make_stamp(robot_interface_hash(), virtual_interface_hash(), "");
}

Result<BuiltScenario> build(const config::ExpandedScenario& scenario, plugin::Catalogue& catalogue,
                            const BuildOptions& options) {
  BuiltScenario built;
  sim::EngineSpec& spec = built.spec;
  spec.step = from_seconds(scenario.scenario.step_s.value);
  spec.seed = scenario.scenario.seed;
  spec.threads = static_cast<unsigned>(scenario.scenario.threads);
  spec.history = from_seconds(scenario.scenario.history_s);
  spec.log = options.log;
  spec.live_clock = options.live_clock;
  // A thread that a driver left behind may still execute code of its plug-in. The engine can then
  // keep the library loaded instead of unmapping that code.
  spec.keep_loaded = [](const void* function) { plugin::keep_loaded(function); };
  for (const config::ObstacleFile& file : scenario.world.obstacles) {
    RAVE_TRY_ASSIGN(auto obstacle, make_obstacle(file));
    spec.world.obstacles.push_back(std::move(obstacle));
  }
  for (const config::MapFile& map : scenario.world.maps) {
    RAVE_TRY(add_map(map, scenario.files, built));
  }
  std::vector<world::Body> bodies;
  RAVE_TRY(add_groups(scenario, catalogue, options, built, bodies));
  if (built.live_reason.empty() && scenario.scenario.clock == config::RunClockMode::kRealTime) {
    built.live_reason = "the scenario says `clock: real_time`";
  }
  for (const config::ExpandedRobot& robot : scenario.robots) {
    world::Body body = bodies[robot.group];
    body.name = robot.name;
    spec.world.robots.push_back(std::move(body));
    const config::RobotGroup& group = scenario.group_of(robot);
    built.robot_kinds.push_back(group.kind.value_or(""));
    spec.robots.push_back({robot.name, group.team, static_cast<std::uint32_t>(robot.group), {}});
  }
  // Each of these reads what the previous ones have made: twins need the types, checks need all
  // sensors, places need the bodies and the kind of each robot, and changes name parameters of
  // types.
  RAVE_TRY(add_twins({scenario, catalogue, options, built}));
  RAVE_TRY(check_sensors_of_checks(scenario, spec));
  RAVE_TRY(put_down_robots(scenario, spec));
  RAVE_TRY(add_changes(scenario, spec));
  RAVE_TRY(add_hand_overs(scenario, spec));
  RAVE_TRY(add_obstacle_changes(scenario, spec));
  RAVE_TRY(add_conductor(scenario, spec));
  spec.local = options.local;
  // The pointers are cleared last, because all checks above look at the function tables to tell
  // real from virtual drivers.
  if (options.others == nullptr) return built;
  const std::vector<std::uint8_t> here = groups_here(scenario, options);
  for (std::size_t g = 0; g < here.size(); ++g) {
    if (here[g] == 0) let_go_of_plugins(spec.types[g]);
  }
  for (std::size_t r = 0; r < spec.robots.size(); ++r) {
    const auto& twin = spec.robots[r].twin;
    if (twin && here[scenario.robots[r].group] == 0) let_go_of_plugins(spec.types[*twin]);
  }
  return built;
}

}  // namespace rave::runtime
