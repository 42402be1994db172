// SPDX-License-Identifier: Apache-2.0
#include "run/scene_json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "rave/base/json_text.hpp"
#include "rave/config/map_image.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/robot/reading.hpp"
#include "run/reading_json.hpp"

namespace rave::gui_server {
namespace {

using Json = nlohmann::ordered_json;

Json pose_json(const Pose2& X) { return Json::array({X.x, X.y, X.yaw}); }

/// An outline at X_BO in its body.
Json shape_json(const config::Outline& outline, const Pose2& X_BO, const config::HeightRange& z_m) {
  Json shape = Json::object();
  const auto corner = [&](double x, double y) {
    const Vec2 p = transform(X_BO, Vec2{x, y});
    return Json::array({p.x, p.y});
  };
  if (outline.disc_radius_m) {
    shape["disc"] = Json::array({X_BO.x, X_BO.y, *outline.disc_radius_m});
  } else if (outline.box_m) {
    const double x = (*outline.box_m)[0] / 2;
    const double y = (*outline.box_m)[1] / 2;
    shape["polygon"] = Json::array({corner(-x, -y), corner(x, -y), corner(x, y), corner(-x, y)});
  } else if (outline.polygon_m) {
    Json points = Json::array();
    for (const auto& point : *outline.polygon_m) points.push_back(corner(point[0], point[1]));
    shape["polygon"] = std::move(points);
  }
  shape["z"] = Json::array({z_m[0], z_m[1]});
  return shape;
}

const char* kind_of(config::ObstacleLayer layer, bool barcode) {
  if (layer == config::ObstacleLayer::kVirtualObstacles) return "virtual";
  return barcode ? "landmark" : "wall";
}

Json file_json(std::size_t id, const config::ObstacleFile& obstacle) {
  Json body = {{"id", id},
               {"name", obstacle.name.value},
               {"kind", kind_of(obstacle.layer, obstacle.barcode.has_value())},
               {"pose", Json::array({obstacle.x_m, obstacle.y_m, deg_to_rad(obstacle.yaw_deg)})},
               {"shapes", Json::array({shape_json(obstacle.outline, Pose2{}, obstacle.z_m)})}};
  if (obstacle.barcode) body["barcode"] = *obstacle.barcode;
  if (obstacle.colour) body["colour"] = *obstacle.colour;
  return body;
}

Status add_map(const config::MapFile& file, const config::InputFiles& files, Json& bodies) {
  RAVE_TRY_ASSIGN(const config::MapImage map, config::read_map(file.file.value, files));
  const Pose2 X_WMap{map.origin_x_m, map.origin_y_m, map.origin_yaw_rad};
  Json body = {{"id", bodies.size()},
               {"name", std::filesystem::path(file.file.value).stem().string()},
               {"kind", kind_of(file.layer, false)},
               {"pose", pose_json(X_WMap)},
               {"shapes", Json::array()}};
  for (const config::MapRectangle& r : config::rectangles_of(map)) {
    body["shapes"].push_back(
        {{"polygon",
          Json::array({Json::array({r.min_x_m, r.min_y_m}), Json::array({r.max_x_m, r.min_y_m}),
                       Json::array({r.max_x_m, r.max_y_m}), Json::array({r.min_x_m, r.max_y_m})})},
         {"z", Json::array({file.z_m[0], file.z_m[1]})}});
  }
  bodies.push_back(std::move(body));
  return {};
}

/// Sensors that a robot has in its file, by name.
const config::SensorFile* sensor_file(const config::RobotFile& robot, const std::string& name) {
  const auto found =
      std::find_if(robot.sensors.begin(), robot.sensors.end(),
                   [&name](const config::SensorFile& sensor) { return sensor.name.value == name; });
  return found == robot.sensors.end() ? nullptr : &*found;
}

Json sensor_json(const record::RecordedSensor& sensor, const config::SensorFile* file, bool hybrid,
                 bool real) {
  const auto kind = static_cast<ReadingKind>(sensor.kind);
  const std::string driver = file == nullptr ? std::string() : file->driver.value;
  const bool is_virtual = sensor.is_virtual || !real;
  Json json = {
      {"name", sensor.name}, {"origin", hybrid ? "hybrid" : (is_virtual ? "virtual" : "real")},
      {"driver", driver},    {"mount", pose_json(sensor.X_RS)},
      {"z", sensor.z_m},     {"period_s", sensor.period_s}};
  add_reading_type(json, kind);
  if (kind == ReadingKind::kRanges) {
    json["range"] = Json::array({sensor.range_min_m, sensor.range_max_m});
    json["bearings"] = sensor.bearings_rad;
    json["cone"] = sensor.cone_rad;
  }
  return json;
}

Json robot_json(const config::ExpandedScenario& scenario, const record::RecordedRobot& recorded) {
  const config::RobotGroup& group = scenario.group_of(scenario.robots[recorded.id.value()]);
  const config::RobotFile& file = group.robot;
  Json drivers = Json::array();
  bool recorded_player = false;
  for (const config::ActuatorFile& actuator : file.actuators) {
    recorded_player |= actuator.driver.value == "replay_ignored";
    drivers.push_back(actuator.driver.value);
  }
  Json json = {{"name", recorded.name},
               {"team", recorded.team},
               {"kind", recorded.kind == "simulated" ? "simulated" : "real"},
               {"word", group.kind.value_or("")},
               {"recorded", recorded_player},
               {"program", file.program ? file.program->driver.value : std::string()},
               {"drivers", std::move(drivers)},
               {"shapes", Json::array()},
               {"sensors", Json::array()}};
  if (file.body.value.colour) json["colour"] = *file.body.value.colour;
  if (file.body.value.barcode) json["barcode"] = *file.body.value.barcode;
  for (const config::ShapeFile& shape : file.body.value.shapes) {
    const Pose2 X_BO{shape.centre_m[0], shape.centre_m[1], deg_to_rad(shape.yaw_deg)};
    json["shapes"].push_back(shape_json(shape.outline, X_BO, shape.z_m));
  }
  return json;
}

}  // namespace

Result<std::string> bodies_of(const config::ExpandedScenario& scenario) {
  Json bodies = Json::array();
  for (const config::ObstacleFile& obstacle : scenario.world.obstacles) {
    bodies.push_back(file_json(bodies.size(), obstacle));
  }
  for (const config::MapFile& map : scenario.world.maps) {
    RAVE_TRY(add_map(map, scenario.files, bodies));
  }
  return bodies.dump();
}

std::string body_json(std::uint32_t id, const world::Obstacle& obstacle) {
  const world::Body& body = obstacle.body;
  const bool is_virtual = body.layer == Layer::kVirtualObstacles;
  Json json = {{"id", id},
               {"name", body.name},
               {"kind", is_virtual ? "virtual" : (body.code ? "landmark" : "wall")},
               {"pose", pose_json(obstacle.X_WB)},
               {"shapes", Json::array()}};
  for (const world::Shape& shape : body.shapes) {
    Json piece = Json::object();
    if (shape.kind == world::ShapeKind::kDisc) {
      piece["disc"] = Json::array({shape.centre.x, shape.centre.y, shape.radius_m});
    } else {
      Json points = Json::array();
      for (const Vec2& corner : shape.vertices())
        points.push_back(Json::array({corner.x, corner.y}));
      piece["polygon"] = std::move(points);
    }
    piece["z"] = Json::array({shape.z0_m, shape.z1_m});
    json["shapes"].push_back(std::move(piece));
  }
  if (body.code) json["barcode"] = *body.code;
  if (!body.colour.empty()) json["colour"] = body.colour;
  return json_text(json);
}

std::string body_json(std::uint32_t id, const config::ObstacleFile& obstacle) {
  return json_text(file_json(id, obstacle));
}

std::string robots_of(const config::ExpandedScenario& scenario, const record::RunInfo& run,
                      const record::StringMap& hybrids) {
  Json robots = Json::array();
  for (const record::RecordedRobot& robot : run.robots)
    robots.push_back(robot_json(scenario, robot));
  for (const record::RecordedSensor& sensor : run.sensors) {
    const std::uint32_t r = sensor.robot.value();
    const config::RobotFile& file = scenario.group_of(scenario.robots[r]).robot;
    const bool hybrid = hybrids.contains(run.robots[r].name + "/" + sensor.name);
    robots[r]["sensors"].push_back(sensor_json(sensor, sensor_file(file, sensor.name), hybrid,
                                               run.robots[r].kind != "simulated"));
  }
  return robots.dump();
}

}  // namespace rave::gui_server
