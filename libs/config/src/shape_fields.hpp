// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "file_checks.hpp"
#include "rave/config/fields.hpp"
#include "rave/config/shape_file.hpp"

namespace rave::config {

/// Larger coordinates are probably typing errors; within, the arithmetic is precise enough.
inline constexpr double kFarthest_m = 1.0e6;
/// The smallest size of a body for which a convex polygon can be made.
inline constexpr double kSmallest_m = 1.0e-4;

constexpr FieldOptions length_m(std::string_view doc) {
  return {.doc = doc, .min = -kFarthest_m, .max = kFarthest_m, .unit = "m"};
}
constexpr FieldOptions distance_m(std::string_view doc) {
  return {.doc = doc, .min = 0, .max = kFarthest_m, .unit = "m"};
}
constexpr FieldOptions between(double min, double max, std::string_view unit,
                               std::string_view doc) {
  return {.doc = doc, .min = min, .max = max, .unit = unit};
}
constexpr FieldOptions angle_deg(std::string_view doc) {
  return {.doc = doc, .min = -360, .max = 360, .unit = "deg"};
}

constexpr auto enum_names(EnumTag<ObstacleLayer> /*tag*/) {
  return std::array{EnumName{ObstacleLayer::kVirtualObstacles, "virtual_obstacles"},
                    EnumName{ObstacleLayer::kMappedReal, "mapped_real"}};
}

constexpr auto enum_names(EnumTag<SensedLayer> /*tag*/) {
  return std::array{EnumName{SensedLayer::kVirtualObstacles, "virtual_obstacles"},
                    EnumName{SensedLayer::kMappedReal, "mapped_real"},
                    EnumName{SensedLayer::kSimulatedRobots, "simulated_robots"},
                    EnumName{SensedLayer::kRealRobots, "real_robots"}};
}

template <class V>
void describe_outline(V& v, Outline& c) {
  v.field("disc_radius_m", c.disc_radius_m,
          between(kSmallest_m, kFarthest_m, "m", "A disc of this radius."));
  v.field(
      "box_m", c.box_m,
      between(kSmallest_m, kFarthest_m, "m", "A box of this length along x and width along y."));
  v.field("polygon_m", c.polygon_m,
          {.doc = "The corners [x, y] of a simple polygon.",
           .min = -kFarthest_m,
           .max = kFarthest_m,
           .unit = "m",
           .min_items = 3,
           .max_items = 1000});
}

template <class V>
void describe_barcode(V& v, std::optional<int>& barcode, std::optional<HeightRange>& z_m) {
  v.field("barcode", barcode,
          {.doc = "Barcode that landmark cameras read; null: none.", .min = 0, .max = 65535});
  v.field("barcode_z_m", z_m,
          length_m("Heights of the barcode, low and high; null: those of the body."));
}

template <class V>
void describe(V& v, ShapeFile& c) {
  describe_outline(v, c.outline);
  v.field("centre_m", c.centre_m, length_m("Origin of the outline in the body frame."));
  v.field("yaw_deg", c.yaw_deg, angle_deg("Rotation of the outline about its origin."));
  v.required("z_m", c.z_m, length_m("Heights above the floor, low and high."));
}

inline void validate(const ShapeFile& c, CheckContext& check) {
  check_outline(c.outline, check);
  check_heights("z_m", c.z_m, check);
}

template <class V>
void describe(V& v, PoseFile& c) {
  v.field("x_m", c.x_m, length_m(""));
  v.field("y_m", c.y_m, length_m(""));
  v.field("yaw_deg", c.yaw_deg, angle_deg("Counter-clockwise from the x axis."));
}

}  // namespace rave::config
