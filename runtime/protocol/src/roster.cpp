// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/roster.hpp"

#include <algorithm>

#include "rave/base/control_characters.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/validate.hpp"
#include "rave/math/trigonometry.hpp"
#include "rave/sim/orders.hpp"

namespace rave::lock_step {
// The roster describes each robot once, for monitors: body, sensors, parameters. A late reader
// receives the last entry of each robot. Limits cut off rather than fail, because nothing in the
// run depends on it.
namespace {

/// The limits of the sequences in roster.idl and of the corners in common.idl.
constexpr std::size_t kMostShapes = 64;
constexpr std::size_t kMostSensors = 64;
constexpr std::size_t kMostParameters = 256;
constexpr std::size_t kMostCorners = 64;
/// The number of corners of the polygon that replaces a disc.
constexpr int kDiscCorners = 16;

// Bodies may be infinitely high, and samples must have finite numbers.
double height(double z_m) { return std::clamp(z_m, -bus::kMaxPosition_m, bus::kMaxPosition_m); }

}  // namespace

void RobotDescription::put_shape(const world::Shape& shape) {
  const std::size_t first = x_m_.size();
  const auto add = [this](Vec2 corner) {
    x_m_.push_back(corner.x);
    y_m_.push_back(corner.y);
  };
  if (shape.kind == world::ShapeKind::kDisc) {
    // At this distance of the corners, r / cos(pi / n), the sides touch the disc from outside.
    const double out_m = shape.radius_m / rave::cos(kPi / kDiscCorners);
    for (int i = 0; i < kDiscCorners; ++i) {
      const SinCos at = rave::sincos(2 * kPi * i / kDiscCorners);
      add({shape.centre.x + out_m * at.cos, shape.centre.y + out_m * at.sin});
    }
  }
  for (const Vec2 corner : shape.vertices().first(std::min(shape.vertices().size(), kMostCorners)))
    add(corner);
  rave_wire_Prism& prism = prisms_.emplace_back();
  prism.z_min_m = height(shape.z0_m);
  prism.z_max_m = height(shape.z1_m);
  // The pointers stay valid because the vectors do not grow afterwards.
  prism.x_m._buffer = x_m_.data() + first;
  prism.y_m._buffer = y_m_.data() + first;
  for (auto* const corners : {&prism.x_m._length, &prism.y_m._length}) {
    *corners = static_cast<std::uint32_t>(x_m_.size() - first);
  }
  prism.x_m._maximum = prism.x_m._length;
  prism.y_m._maximum = prism.y_m._length;
}

void RobotDescription::put_body(const world::Body& body) {
  const auto shapes = std::span(body.shapes).first(std::min(body.shapes.size(), kMostShapes));
  std::size_t corners = 0;
  // At most: a disc has no corners of its own, a polygon needs no replacement.
  for (const world::Shape& shape : shapes) corners += shape.vertices().size() + kDiscCorners;
  prisms_.clear();
  x_m_.clear();
  y_m_.clear();
  x_m_.reserve(corners);
  y_m_.reserve(corners);
  for (const world::Shape& shape : shapes) put_shape(shape);
  bus::borrow(entry_.body, prisms_);
}

void RobotDescription::put_sensors(const sim::RobotType& type) {
  sensors_.clear();
  for (const sim::SensorSpec& sensor : type.sensors) {
    if (sensors_.size() == kMostSensors) break;
    rave_wire_SensorMount& mount = sensors_.emplace_back();
    bus::put_text(mount.name, sensor.name);
    bus::put_text(mount.type, sensor.driver);
    mount.x_m = sensor.X_RS.x;
    mount.y_m = sensor.X_RS.y;
    mount.z_m = height(sensor.z_m);
    mount.yaw_rad = sensor.X_RS.yaw;
  }
  bus::borrow(entry_.sensors, sensors_);
}

bus::RosterEntry& RobotDescription::fill(const sim::EngineSpec& spec, RobotId robot,
                                         const NamedValues& parameters) {
  const sim::RobotSpec& its = spec.robots[robot.value()];
  const sim::RobotType& type = spec.types[its.type];
  entry_ = {};
  entry_.robot = robot.value();
  bus::put_text(entry_.name, its.name);
  bus::put_text(entry_.team, its.team);
  entry_.leader = rave_wire_kNone;
  entry_.kind = type.simulated ? rave_wire_ROBOT_SIMULATED : rave_wire_ROBOT_REAL;
  entry_.takes = sim::declared_orders(type);
  put_body(spec.world.robots[robot.value()]);
  put_sensors(type);
  parameters_.clear();
  for (const auto& [name, value] : parameters) {
    if (parameters_.size() == kMostParameters) break;
    rave_wire_Parameter& parameter = parameters_.emplace_back();
    bus::put_text(parameter.name, name);
    bus::put_text(parameter.value, without_control_characters(value, " "));
  }
  bus::borrow(entry_.parameters, parameters_);
  return entry_;
}

Status Roster::tell(const sim::EngineSpec& spec,
                    const std::function<NamedValues(RobotId)>& parameters_of,
                    const std::function<Driver(RobotId)>& driver_of) {
  Status wrong;
  while (!due_.empty()) {
    const RobotId robot(*due_.begin());
    bus::RosterEntry& entry = description_.fill(spec, robot, parameters_of(robot));
    entry.host = host_;
    entry.revision = revision_ + 1;
    if (driver_of) {
      const Driver driver = driver_of(robot);
      bus::put_text(entry.driver, without_control_characters(driver.name, " "));
      entry.driver_page = driver.page;
    }
    const Status written = writer_.write(entry);
    // A slow reader blocks the writer. The rest stays due and is tried in a later step, so the run
    // never waits.
    if (!written && written.error().code == ErrorCode::kTimeout) break;
    // An entry that cannot be sent at all is not tried again; the others are.
    if (!written) wrong = written;
    ++revision_;
    due_.erase(due_.begin());
  }
  return wrong;
}

}  // namespace rave::lock_step
