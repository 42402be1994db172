// SPDX-License-Identifier: Apache-2.0
#include "rave/real_time/roster.hpp"

#include <algorithm>

#include "rave/bus/sequence.hpp"
#include "rave/math/convex_polygon.hpp"

namespace rave::real_time {
namespace {

/// The circle about a body, with corners; who needs its shapes has the scenario.
struct Outline {
  static constexpr int kCorners = 12;
  std::vector<double> x_m, y_m;
  std::vector<rave_wire_Prism> prisms = std::vector<rave_wire_Prism>(1);

  Outline(const world::Body& body, double radius_m) {
    if (const auto circle = ConvexPolygon::regular(kCorners, radius_m)) {
      for (const Vec2& corner : circle->vertices()) {
        x_m.push_back(corner.x);
        y_m.push_back(corner.y);
      }
    }
    rave_wire_Prism& prism = prisms.front();
    bus::borrow(prism.x_m, x_m);
    bus::borrow(prism.y_m, y_m);
    if (body.shapes.empty()) return;
    prism.z_min_m = body.shapes.front().z0_m;
    prism.z_max_m = body.shapes.front().z1_m;
    for (const world::Shape& shape : body.shapes) {
      prism.z_min_m = std::min(prism.z_min_m, shape.z0_m);
      prism.z_max_m = std::max(prism.z_max_m, shape.z1_m);
    }
  }
};

}  // namespace

Result<Roster> Roster::create(bus::Bus& bus, std::uint32_t own_host,
                              std::vector<std::uint32_t> host_of) {
  RAVE_TRY_ASSIGN(auto writer, bus::Writer<bus::RosterEntry>::create(bus));
  RAVE_TRY_ASSIGN(auto reader, bus::Reader<bus::RosterEntry>::create(bus));
  return Roster(own_host, std::move(host_of), std::move(writer), std::move(reader));
}

void Roster::tell(const sim::Engine& engine, RobotId robot) {
  const sim::EngineSpec& spec = engine.spec();
  const sim::RobotSpec& its = spec.robots[robot.value()];
  Outline outline(spec.world.robots[robot.value()], engine.body_radius_m(robot));
  bus::RosterEntry entry{};
  entry.robot = robot.value();
  entry.revision = ++revision_of_[robot];
  entry.host = own_host_;
  entry.leader = rave_wire_kNone;
  entry.kind = spec.types[its.type].simulated ? rave_wire_ROBOT_SIMULATED : rave_wire_ROBOT_REAL;
  bus::put_text(entry.name, its.name);
  bus::put_text(entry.team, its.team);
  bus::borrow(entry.body, outline.prisms);
  static_cast<void>(writer_.write(entry));
}

void Roster::hear() {
  reader_.take([this](const bus::RosterEntry& entry) {
    if (entry.host == own_host_) return;
    const bool fits = entry.robot < host_of_.size() && host_of_[entry.robot] == entry.host &&
                      entry.kind != rave_wire_ROBOT_SHADOW;
    if (fits) {
      heard_[RobotId(entry.robot)] = entry.kind == rave_wire_ROBOT_SIMULATED;
    } else if (!std::exchange(refused_, true)) {
      reader_.refuse(entry, fmt::format("robot {} does not run on host {}, or not so", entry.robot,
                                        entry.host));
    }
  });
}

std::vector<RobotReality> Roster::take() {
  std::vector<RobotReality> realities;
  for (const auto& [robot, simulated] : heard_) realities.push_back({robot, simulated});
  heard_.clear();
  return realities;
}

}  // namespace rave::real_time
