// SPDX-License-Identifier: Apache-2.0
#include "sample_checks.hpp"

namespace rave::bus {
namespace {

Status check_finite(std::string_view field, double value) {
  if (std::isfinite(value)) return {};
  return invalid("{} is {}", field, value);
}

Status check_shape(const std::string& field, const rave_wire_BodyShape& shape) {
  if (shape.kind > rave_wire_SHAPE_POLYGON) return invalid("{}.kind is unknown", field);
  const auto x = elements(shape.x_m);
  const auto y = elements(shape.y_m);
  const bool disc = shape.kind == rave_wire_SHAPE_DISC;
  if (x.size() != y.size() || (disc ? x.size() != 1 : x.size() < 3)) {
    return invalid("{} has {} x and {} y; a {}", field, x.size(), y.size(),
                   disc ? "disc has one of each" : "polygon has 3 corners or more");
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    RAVE_TRY(check_number(field + ".x_m", x[i], kMaxPosition_m));
    RAVE_TRY(check_number(field + ".y_m", y[i], kMaxPosition_m));
  }
  // A polygon has no radius. An exact zero is required, so that no second meaning creeps in.
  const bool radius = disc ? shape.radius_m > 0 && shape.radius_m <= kMaxPosition_m
                           : std::fpclassify(shape.radius_m) == FP_ZERO;
  if (!radius) return invalid("{}.radius_m is {}", field, shape.radius_m);
  RAVE_TRY(check_finite(field + ".z_min_m", shape.z_min_m));
  RAVE_TRY(check_finite(field + ".z_max_m", shape.z_max_m));
  if (shape.z_min_m < shape.z_max_m) return {};
  return invalid("{}: z_min_m {} is not below z_max_m {}", field, shape.z_min_m, shape.z_max_m);
}

/// Checks the members that only new obstacles have.
Status check_body(const std::string& field, const rave_wire_ObstacleChange& change) {
  const auto shapes = elements(change.shapes);
  const bool adds = change.kind == rave_wire_OBSTACLE_ADD;
  if (adds == shapes.empty()) {
    return invalid("{}.shapes {}", field, adds ? "is empty" : "are of one that is not new");
  }
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    RAVE_TRY(check_shape(fmt::format("{}.shapes[{}]", field, i), shapes[i]));
  }
  if (change.layer > rave_wire_LAYER_MAPPED_REAL) return invalid("{}.layer is unknown", field);
  RAVE_TRY(check_label(field + ".colour", change.colour, false));
  RAVE_TRY(check_finite(field + ".code_z_min_m", change.code_z_min_m));
  return check_finite(field + ".code_z_max_m", change.code_z_max_m);
}

}  // namespace

Status check_obstacle_change(const std::string& field, const rave_wire_ObstacleChange& change) {
  if (change.kind > rave_wire_OBSTACLE_REMOVE) return invalid("{}.kind is unknown", field);
  RAVE_TRY(check_id(field + ".id", change.id));
  RAVE_TRY(check_label(field + ".name", change.name, change.kind == rave_wire_OBSTACLE_ADD));
  RAVE_TRY(check_number(field + ".x_m", change.x_m, kMaxPosition_m));
  RAVE_TRY(check_number(field + ".y_m", change.y_m, kMaxPosition_m));
  RAVE_TRY(check_number(field + ".yaw_rad", change.yaw_rad, kMaxAngle_rad));
  return check_body(field, change);
}

Status validate(const Obstacle& sample) {
  RAVE_TRY(check_writer(sample));
  RAVE_TRY(check_id("id", sample.id));
  if (sample.revision == 0) return invalid("revision is 0");
  RAVE_TRY(check_obstacle_change("stands", sample.stands));
  if (sample.stands.id != sample.id) {
    return invalid("stands.id is {}, of obstacle {}", sample.stands.id, sample.id);
  }
  if (!sample.removed || sample.stands.kind == rave_wire_OBSTACLE_ADD) return {};
  return invalid("removed is set for an obstacle that was not added");
}

}  // namespace rave::bus
