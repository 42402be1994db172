// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/bus/sequence.hpp"
#include "rave/bus/topics.hpp"

namespace rave::bus::testing {

/// Memory of robots for a sample that borrows it. Robot i of `count` is at (i + step, -i).
struct RobotArrays {
  std::vector<std::uint32_t> id;
  std::vector<double> x, y, yaw, vx, vy, wz;
  std::vector<std::int64_t> stamp_ns;

  RobotArrays(std::uint32_t count, std::uint64_t step, std::uint32_t first = 0) {
    for (std::uint32_t i = first; i < first + count; ++i) {
      id.push_back(i);
      x.push_back(static_cast<double>(i) + static_cast<double>(step));
      y.push_back(-static_cast<double>(i));
      yaw.push_back(0.001 * i);
      vx.push_back(1.5);
      vy.push_back(-0.5);
      wz.push_back(0.25);
      stamp_ns.push_back(static_cast<std::int64_t>(step) * 10'000'000);
    }
  }
  void lend(rave_wire_PlanarRobots& robots) {
    borrow(robots.id, id);
    borrow(robots.x_m, x);
    borrow(robots.y_m, y);
    borrow(robots.yaw_rad, yaw);
    borrow(robots.vx_mps, vx);
    borrow(robots.vy_mps, vy);
    borrow(robots.wz_radps, wz);
    borrow(robots.stamp_ns, stamp_ns);
  }
  void lend(rave_wire_PlanarTwists& twists) {
    borrow(twists.id, id);
    borrow(twists.vx_mps, vx);
    borrow(twists.vy_mps, vy);
    borrow(twists.wz_radps, wz);
  }
};

/// An obstacle that came: a box of 1 m.
struct NewBox {
  std::vector<double> x{0, 1, 1, 0};
  std::vector<double> y{0, 0, 1, 1};
  std::vector<rave_wire_BodyShape> shapes = std::vector<rave_wire_BodyShape>(1);
  Obstacle sample{};

  explicit NewBox(std::uint32_t id) {
    sample.writer = 1;
    sample.id = id;
    sample.revision = id + std::uint64_t{1};
    sample.stands.kind = rave_wire_OBSTACLE_ADD;
    sample.stands.id = id;
    put_text(sample.stands.name, "box" + std::to_string(id));
    shapes[0].kind = rave_wire_SHAPE_POLYGON;
    borrow(shapes[0].x_m, x);
    borrow(shapes[0].y_m, y);
    shapes[0].z_max_m = 1;
    borrow(sample.stands.shapes, shapes);
  }
  NewBox(const NewBox&) = delete;
  NewBox& operator=(const NewBox&) = delete;
};

}  // namespace rave::bus::testing
