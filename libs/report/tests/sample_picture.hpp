// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/report/picture.hpp"

namespace rave::report {

/// A small picture in which every feature occurs: 2 tubes, a wall, a virtual obstacle, two recorded
/// robots (one loses its pose, one has a gap), an odometry track, a simulated robot, a hunter, and
/// an instant with hits on four kinds and two sightings.
[[nodiscard]] Picture sample_picture();

[[nodiscard]] std::vector<Vec2> square_W(Vec2 centre_W, double half_m);

}  // namespace rave::report
