// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rave/math/pose.hpp"
#include "rave/report/picture.hpp"
#include "rave/world/body.hpp"

namespace rave::drawing {

/// The corners of a shape of a body at X_WB; a disc becomes a polygon with many.
[[nodiscard]] std::vector<Vec2> outline_of(const world::Shape& shape, const Pose2& X_WB);
[[nodiscard]] std::vector<Vec2> disc_outline(Vec2 centre_W, double radius_m);

/// Adds a robot: its largest shape with the name and heading, the others as plain bodies.
void add_robot(const world::Body& body, const Pose2& X_WR, report::Kind kind,
               report::Picture& picture);

/// How obstacles are shown: codes and walls have looks of their own.
[[nodiscard]] report::Kind kind_of(const world::Body& body);

}  // namespace rave::drawing
