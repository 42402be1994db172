// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/config/world_file.hpp"
#include "shape_fields.hpp"

// The description of world files.
namespace rave::config {

template <class V>
void describe(V& v, ObstacleFile& c) {
  v.required("name", c.name, {.doc = "Unique in the world."});
  describe_outline(v, c.outline);
  v.field("x_m", c.x_m, length_m("Position of the origin of the outline."));
  v.field("y_m", c.y_m, length_m("Position of the origin of the outline."));
  v.field("yaw_deg", c.yaw_deg, angle_deg("Rotation of the outline about its origin."));
  v.field("z_m", c.z_m, length_m("Heights above the floor, low and high."));
  v.field("layer", c.layer, {.doc = "Layer: whether the obstacle also exists on the real floor."});
  describe_barcode(v, c.barcode, c.barcode_z_m);
  v.field("colour", c.colour,
          {.doc = "Colour in pictures, `#rrggbb`; null: chosen automatically."});
}

inline void validate(const ObstacleFile& c, CheckContext& check) {
  check_name("name", *c.name, check);
  check_outline(c.outline, check);
  check_heights("z_m", c.z_m, check);
  check_barcode(c.barcode, c.barcode_z_m, check);
  check_colour(c.colour, check);
}

template <class V>
void describe(V& v, MoveObstacleFile& c) {
  v.required("name", c.name, {.doc = "Name of an existing obstacle."});
  v.field("x_m", c.x_m, length_m("New position of the origin of the outline."));
  v.field("y_m", c.y_m, length_m("New position of the origin of the outline."));
  v.field("yaw_deg", c.yaw_deg, angle_deg("Rotation of the outline about its origin."));
}

/// The keys of an edit, also as part of another struct.
template <class V>
void describe_edit(V& v, ObstacleEdit& c) {
  v.field("add_obstacle", c.add_obstacle,
          {.doc = "Obstacle to add; no other obstacle may have its name at that time."});
  v.field("move_obstacle", c.move_obstacle, {.doc = "Obstacle to move."});
  v.field("remove_obstacle", c.remove_obstacle, {.doc = "Name of an obstacle to remove."});
}

/// How many of the members are set.
[[nodiscard]] inline int parts_of(const ObstacleEdit& c) noexcept {
  return int{c.add_obstacle.has_value()} + int{c.move_obstacle.has_value()} +
         int{c.remove_obstacle.has_value()};
}

template <class V>
void describe(V& v, ObstacleEdit& c) {
  describe_edit(v, c);
}

inline void validate(const ObstacleEdit& c, CheckContext& check) {
  if (parts_of(c) == 1) return;
  check.error("",
              "an edit has {} of `add_obstacle`, `move_obstacle` and `remove_obstacle`; expected "
              "one",
              parts_of(c));
}

template <class V>
void describe(V& v, MapFile& c) {
  v.required("file", c.file,
             {.doc = "The YAML of a ROS map_server map, relative to this file.", .min_items = 1});
  v.field("z_m", c.z_m, length_m("Heights of its walls, low and high."));
  v.field("layer", c.layer, {.doc = "Layer: whether the walls also exist on the real floor."});
}

inline void validate(const MapFile& c, CheckContext& check) { check_heights("z_m", c.z_m, check); }

constexpr FieldOptions obstacle_list() {
  return {.doc = "Static obstacles (upright prisms).", .max_items = 100000};
}
constexpr FieldOptions map_list() {
  return {.doc = "Maps whose occupied cells are walls.", .max_items = 100};
}

template <class V>
void describe(V& v, WorldFile& c) {
  v.field("description", c.description, {.doc = "Free text."});
  v.field("obstacles", c.obstacles, obstacle_list());
  v.field("maps", c.maps, map_list());
}

inline void validate(const WorldFile& c, CheckContext& check) {
  check_unique("obstacle", c.obstacles, check);
}

}  // namespace rave::config
