// SPDX-License-Identifier: Apache-2.0
#include "foxglove/foxglove_scene.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "foxglove/foxglove_wire.hpp"
#include "rave/base/json_text.hpp"
#include "rave/math/pose.hpp"
#include "rave/math/transform.hpp"
#include "rave/world/body.hpp"

namespace rave::gui_server {
namespace {

using SceneJson = nlohmann::ordered_json;

/// Red, green, blue from 0 to 1, and how opaque.
using Paint = std::array<double, 4>;

// The colours of the page.
constexpr Paint kWallPaint = {0.55, 0.48, 0.40, 1};
constexpr Paint kLandmarkPaint = {0.84, 0.85, 0.88, 1};
constexpr Paint kVirtualPaint = {0.34, 0.71, 0.91, 0.5};
constexpr Paint kRealPaint = {0.18, 0.53, 0.87, 1};
constexpr Paint kSimulatedPaint = {0.55, 0.59, 0.66, 1};
constexpr Paint kStoppedPaint = {0.85, 0.15, 0.15, 1};
constexpr Paint kHeadingPaint = {1, 1, 1, 1};
constexpr double kStaleOpacity = 0.3;

/// `#rrggbb`, as far as it is one.
Paint painted(const SceneJson& thing, Paint usual) {
  const auto found = thing.find("colour");
  if (found == thing.end() || !found->is_string()) return usual;
  const auto& text = found->get_ref<const std::string&>();
  unsigned value = 0;
  if (text.size() != 7 || text[0] != '#') return usual;
  const auto [end, error] = std::from_chars(text.data() + 1, text.data() + 7, value, 16);
  if (error != std::errc() || end != text.data() + 7) return usual;
  return {((value >> 16U) & 0xffU) / 255.0, ((value >> 8U) & 0xffU) / 255.0,
          (value & 0xffU) / 255.0, usual[3]};
}

SceneJson paint_json(const Paint& paint) {
  return {{"r", paint[0]}, {"g", paint[1]}, {"b", paint[2]}, {"a", paint[3]}};
}

SceneJson point_json(double x, double y, double z) { return {{"x", x}, {"y", y}, {"z", z}}; }

SceneJson empty_entity(const std::string& id, const std::string& frame, double time_s) {
  SceneJson entity = {{"timestamp", foxglove_stamp(time_s)},
                      {"frame_id", frame},
                      {"id", id},
                      // 0: until it is replaced or deleted.
                      {"lifetime", {{"sec", 0}, {"nsec", 0}}},
                      // It moves with its frame: a robot is drawn again only when its colour
                      // changes, not with each pose.
                      {"frame_locked", true},
                      {"metadata", SceneJson::array()}};
  for (const char* const list :
       {"arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"}) {
    entity[list] = SceneJson::array();
  }
  return entity;
}

/// A rectangle has a form that is drawn faster than triangles.
bool add_cube(std::span<const Vec2> corners, const SceneJson& z, const Pose2& X_FB,
              const Paint& paint, SceneJson& entity) {
  if (corners.size() != 4) return false;
  const Vec2 along{corners[1].x - corners[0].x, corners[1].y - corners[0].y};
  const Vec2 across{corners[3].x - corners[0].x, corners[3].y - corners[0].y};
  const double length = std::hypot(along.x, along.y);
  const double width = std::hypot(across.x, across.y);
  const Vec2 opposite{corners[1].x + across.x, corners[1].y + across.y};
  const double off = std::hypot(opposite.x - corners[2].x, opposite.y - corners[2].y);
  const double skew = std::abs(along.x * across.x + along.y * across.y);
  // A parallelogram (`off` near 0) whose sides are perpendicular (their scalar product near 0), up
  // to the rounding of files.
  if (off > 1e-6 * (length + width) || skew > 1e-6 * length * width) return false;
  const double z0 = z.at(0).get<double>();
  const double z1 = z.at(1).get<double>();
  const Vec2 centre =
      transform(X_FB, Vec2{(corners[0].x + corners[2].x) / 2, (corners[0].y + corners[2].y) / 2});
  entity["cubes"].push_back({{"pose", foxglove_pose(centre.x, centre.y, (z0 + z1) / 2,
                                                    X_FB.yaw + std::atan2(along.y, along.x))},
                             {"size", point_json(length, width, z1 - z0)},
                             {"color", paint_json(paint)}});
  return true;
}

/// Triangles of a convex prism: floor, ceiling, and two for each side.
SceneJson prism_triangles(std::span<const Vec2> corners, double z0, double z1, const Pose2& X_FB,
                          const Paint& paint) {
  SceneJson points = SceneJson::array();
  for (const double z : {z0, z1}) {
    for (const Vec2& corner : corners) points.push_back(point_json(corner.x, corner.y, z));
  }
  SceneJson indices = SceneJson::array();
  const auto add = [&indices](std::size_t a, std::size_t b, std::size_t c) {
    for (const std::size_t index : {a, b, c}) indices.push_back(index);
  };
  const std::size_t n = corners.size();
  // A convex polygon is a fan about its first corner. The floor turns the other way round, so that
  // all sides face outwards.
  for (std::size_t i = 1; i + 1 < n; ++i) {
    add(0, i + 1, i);
    add(n, n + i, n + i + 1);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    add(i, next, n + next);
    add(i, n + next, n + i);
  }
  return {{"pose", foxglove_pose(X_FB.x, X_FB.y, 0, X_FB.yaw)},
          {"points", std::move(points)},
          {"color", paint_json(paint)},
          {"colors", SceneJson::array()},
          {"indices", std::move(indices)}};
}

/// `X_FB`: of the body in the frame of the entity.
void add_shape(const SceneJson& shape, const Pose2& X_FB, const Paint& paint, SceneJson& entity) {
  const double z0 = shape.at("z").at(0).get<double>();
  const double z1 = shape.at("z").at(1).get<double>();
  if (const auto disc = shape.find("disc"); disc != shape.end()) {
    const Vec2 centre = transform(X_FB, Vec2{disc->at(0).get<double>(), disc->at(1).get<double>()});
    const double diameter = 2 * disc->at(2).get<double>();
    entity["cylinders"].push_back({{"pose", foxglove_pose(centre.x, centre.y, (z0 + z1) / 2, 0)},
                                   {"size", point_json(diameter, diameter, z1 - z0)},
                                   {"bottom_scale", 1},
                                   {"top_scale", 1},
                                   {"color", paint_json(paint)}});
    return;
  }
  const auto polygon = shape.find("polygon");
  if (polygon == shape.end()) return;
  std::vector<Vec2> corners;
  for (const SceneJson& corner : *polygon) {
    corners.push_back({corner.at(0).get<double>(), corner.at(1).get<double>()});
  }
  if (add_cube(corners, shape.at("z"), X_FB, paint, entity)) return;
  // An outline may have corners that point inwards: a fan of triangles would fill them.
  const auto pieces = world::make_prisms(corners, z0, z1);
  if (!pieces) return;
  for (const world::Shape& piece : *pieces) {
    entity["triangles"].push_back(prism_triangles(piece.vertices(), z0, z1, X_FB, paint));
  }
}

Paint paint_of_kind(const std::string& kind) {
  if (kind == "virtual") return kVirtualPaint;
  return kind == "landmark" ? kLandmarkPaint : kWallPaint;
}

/// How high the highest shape is, metres.
double top_of(const SceneJson& shapes) {
  double top = 0;
  for (const SceneJson& shape : shapes) top = std::max(top, shape.at("z").at(1).get<double>());
  return top;
}

}  // namespace

std::string foxglove_frame(const std::string& robot) { return "robot/" + robot; }

SceneJson foxglove_stamp(double time_s) {
  constexpr std::uint64_t kSecond_ns = 1'000'000'000;
  const std::uint64_t ns = foxglove_ns(time_s);
  return {{"sec", ns / kSecond_ns}, {"nsec", ns % kSecond_ns}};
}

SceneJson foxglove_pose(double x_m, double y_m, double z_m, double yaw_rad) {
  return {{"position", point_json(x_m, y_m, z_m)},
          {"orientation",
           {{"x", 0}, {"y", 0}, {"z", std::sin(yaw_rad / 2)}, {"w", std::cos(yaw_rad / 2)}}}};
}

SceneJson body_entity(const SceneJson& body, double time_s) {
  SceneJson entity =
      empty_entity(std::to_string(body.at("id").get<std::int64_t>()), "world", time_s);
  const auto kind = body.at("kind").get<std::string>();
  entity["metadata"].push_back({{"key", "name"}, {"value", body.at("name")}});
  entity["metadata"].push_back({{"key", "kind"}, {"value", kind}});
  const SceneJson& pose = body.at("pose");
  const Pose2 X_WB{pose.at(0).get<double>(), pose.at(1).get<double>(), pose.at(2).get<double>()};
  const Paint paint = painted(body, paint_of_kind(kind));
  for (const SceneJson& shape : body.at("shapes")) add_shape(shape, X_WB, paint, entity);
  return entity;
}

SceneJson robot_entity(const SceneJson& robot, std::uint16_t flags, double time_s) {
  const auto name = robot.at("name").get<std::string>();
  SceneJson entity = empty_entity(name, foxglove_frame(name), time_s);
  entity["metadata"].push_back({{"key", "team"}, {"value", robot.at("team")}});
  entity["metadata"].push_back({{"key", "kind"}, {"value", robot.at("kind")}});
  const bool real = robot.at("kind") == "real";
  Paint paint = painted(robot, real ? kRealPaint : kSimulatedPaint);
  if ((flags & kStopped) != 0) paint = kStoppedPaint;
  if ((flags & kStale) != 0) paint[3] = kStaleOpacity;
  for (const SceneJson& shape : robot.at("shapes")) add_shape(shape, Pose2{}, paint, entity);
  const double top = top_of(robot.at("shapes"));
  entity["arrows"].push_back({{"pose", foxglove_pose(0, 0, top + 0.01, 0)},
                              {"shaft_length", 0.15},
                              {"shaft_diameter", 0.03},
                              {"head_length", 0.08},
                              {"head_diameter", 0.08},
                              {"color", paint_json(kHeadingPaint)}});
  entity["texts"].push_back({{"pose", foxglove_pose(0, 0, top + 0.2, 0)},
                             {"billboard", true},
                             {"font_size", 0.12},
                             {"scale_invariant", false},
                             {"color", paint_json(kHeadingPaint)},
                             {"text", name}});
  return entity;
}

std::string scene_update(FoxgloveScene scene, double time_s) {
  // Of a deletion: one id, or all.
  constexpr int kOfId = 0;
  constexpr int kOfAll = 1;
  SceneJson deletions = SceneJson::array();
  if (scene.anew) {
    deletions.push_back({{"timestamp", foxglove_stamp(time_s)}, {"type", kOfAll}, {"id", ""}});
  }
  for (std::string& id : scene.gone) {
    deletions.push_back(
        {{"timestamp", foxglove_stamp(time_s)}, {"type", kOfId}, {"id", std::move(id)}});
  }
  const SceneJson update = {{"deletions", std::move(deletions)},
                            {"entities", std::move(scene.entities)}};
  return json_text(update);
}

}  // namespace rave::gui_server
