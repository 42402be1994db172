// SPDX-License-Identifier: Apache-2.0
#include "robot_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outlines.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"
#include "rave/sim/engine.hpp"

namespace rave::drawing {
namespace {

using report::Kind;
using report::Picture;

/// One sensor as a picture needs it; real ones are not opened, so less is known of them.
struct Look {
  std::string name;
  std::string driver;
  bool is_virtual = false;
  Pose2 X_RS;
  double z_m = 0;
  double period_s = 0;
  std::vector<double> bearings_rad;  ///< In the sensor frame; empty if it has no rays.
  double range_min_m = 0;
  double range_max_m = 0;
  double cone_rad = 0;
};

/// A camera has no rays; where its parameters name its edges, those are shown.
void add_field_of_view(const plugin::ParamSet& params, Look& look) {
  double right_deg = 0;
  double left_deg = 0;
  int found = 0;
  for (const ParamValue& value : params.values()) {
    const std::string_view name = value.name;
    if (name == "fov_min_deg") ++found, right_deg = value.number;
    if (name == "fov_max_deg") ++found, left_deg = value.number;
    if (name == "range_max_m") look.range_max_m = value.number;
    if (name == "range_min_m") look.range_min_m = value.number;
  }
  // One edge alone says nothing about the field.
  if (found != 2) return;
  constexpr int kSteps = 32;
  for (int i = 0; i <= kSteps; ++i) {
    look.bearings_rad.push_back(deg_to_rad(right_deg + (left_deg - right_deg) * i / kSteps));
  }
}

std::vector<Look> looks_of(const sim::EngineSpec& spec) {
  std::vector<Look> looks;
  for (const sim::SensorSpec& sensor : spec.types[0].sensors) {
    Look& look = looks.emplace_back();
    look.name = sensor.name;
    look.driver = sensor.driver;
    look.is_virtual = sensor.virtual_ops != nullptr || sensor.hybrid;
    look.X_RS = sensor.X_RS;
    look.z_m = sensor.z_m;
    look.period_s = sensor.period_steps > 1 ? sensor.period_steps * spec.step.seconds() : 0;
    add_field_of_view(sensor.params, look);
  }
  return looks;
}

/// What virtual range sensors say of themselves once they are made.
Status add_rays(sim::EngineSpec spec, std::vector<Look>& looks) {
  sim::RobotType& type = spec.types[0];
  // Rays are known only to a sensor that was made, and only virtual sensors can be made without a
  // device. An engine with just these gives them the same start as a run.
  keep_virtual_sensors(type);
  RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(spec)));
  std::uint32_t s = 0;
  for (Look& look : looks) {
    if (!look.is_virtual) continue;
    // `s` counts the sensors that were left in the engine, which keep their order.
    const SensorInfo& info = *engine->sensor(RobotId(0), s++).info;
    if (info.kind != ReadingKind::kRanges || info.bearings_rad == nullptr) continue;
    look.bearings_rad.assign(info.bearings_rad, info.bearings_rad + info.capacity);
    look.range_min_m = info.range_min_m;
    look.range_max_m = info.range_max_m;
    look.cone_rad = info.cone_rad;
  }
  return {};
}

/// Rays as the outline of what is swept; a cone sensor's reading is an arc.
std::vector<double> directions_of(const Look& look) {
  if (look.cone_rad <= 0) return look.bearings_rad;
  constexpr int kSteps = 12;
  std::vector<double> directions;
  for (const double middle_rad : look.bearings_rad) {
    for (int i = 0; i <= kSteps; ++i) {
      directions.push_back(middle_rad + look.cone_rad * (static_cast<double>(i) / kSteps - 0.5));
    }
  }
  return directions;
}

std::string line_of(const Look& look) {
  std::string text =
      fmt::format("{} ({}): x {:g} m, y {:g} m, height {:g} m, yaw {:g}°", look.name, look.driver,
                  look.X_RS.x, look.X_RS.y, look.z_m, rad_to_deg(look.X_RS.yaw));
  if (!look.bearings_rad.empty()) {
    const auto [low, high] =
        std::minmax_element(look.bearings_rad.begin(), look.bearings_rad.end());
    const double width_deg = rad_to_deg(*high - *low + look.cone_rad);
    text += fmt::format(", sees {:.4g}°", width_deg);
    if (look.range_max_m > 0) {
      text += fmt::format(" from {:g} to {:g} m", look.range_min_m, look.range_max_m);
    }
  }
  if (look.period_s > 0) text += fmt::format(", each {:g} s", look.period_s);
  return text + ".";
}

void add_sensor(const Look& look, const Pose2& X_WR, double body_m, double scale, std::size_t index,
                Picture& picture) {
  Pose2 X_WS = compose(X_WR, look.X_RS);
  // Fans that begin at the same point are drawn as one: sensors in one place are separated by a
  // distance too small to see.
  X_WS.x += 1e-6 * body_m * static_cast<double>(index);
  const Vec2 from_W = X_WS.position();
  // A mark of 6 % of the body: visible on robots of any size.
  picture.instant->robots.push_back({disc_outline(from_W, 0.06 * body_m), X_WS, Kind::kSensor,
                                     look.name, std::string(report::robot_colour(index))});
  for (const double direction_rad : directions_of(look)) {
    const Vec2 to_S = (scale * look.range_max_m) * rotate(direction_rad, {1, 0});
    picture.instant->hits.push_back({from_W, transform(X_WS, to_S), std::nullopt});
  }
}

}  // namespace

void keep_virtual_sensors(sim::RobotType& type) {
  for (sim::SensorSpec& sensor : type.sensors) sensor = sim::virtual_half_of(std::move(sensor));
  std::erase_if(type.sensors, [](const auto& sensor) { return sensor.virtual_ops == nullptr; });
  type.actuators.clear();
  type.controllers.clear();
  type.program.reset();
  type.pose_from.reset();
  type.simulated = true;
}

Result<Picture> draw_one_robot(const config::AnyFile& input, runtime::BuiltScenario built) {
  const world::Body body = built.spec.world.robots[0];
  std::vector<Look> looks = looks_of(built.spec);
  double farthest_m = 0;
  RAVE_TRY(add_rays(std::move(built.spec), looks));
  for (const Look& look : looks) {
    if (!look.bearings_rad.empty()) farthest_m = std::max(farthest_m, look.range_max_m);
  }
  Picture picture;
  picture.title = input.path.stem().string();
  picture.subtitle = input.scenario.groups[0].robot.description;
  picture.instant.emplace();
  const double body_m = body.radius_m();
  const Pose2 X_WR;
  for (const world::Shape& shape : body.shapes) {
    picture.bodies.push_back({outline_of(shape, X_WR), Kind::kRobotPart, "", body.colour});
  }
  picture.instant->heading = "The body from above, with its sensors; forward is to the right";
  picture.instant->show_all_rays = true;
  // Fields of view are many bodies long; the body is what this picture is about.
  const double longest_m = 2.5 * body_m;
  const double scale = farthest_m > longest_m ? longest_m / farthest_m : 1;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    add_sensor(looks[i], X_WR, body_m, scale, i, picture);
  }
  if (scale < 1) {
    picture.caption.push_back(fmt::format(
        "Fields of view are drawn at {:.2g} times their length; the body is to scale.", scale));
  }
  for (const Look& look : looks) {
    picture.caption.push_back(line_of(look));
  }
  return picture;
}

}  // namespace rave::drawing
