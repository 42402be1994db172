// SPDX-License-Identifier: Apache-2.0
#include "foxglove_schemas.hpp"

#include <nlohmann/json.hpp>

namespace rave::gui_server {
namespace {

// JSON Schemas of the messages. Clients recognise the types of the Foxglove SDK by their title.
using SchemaJson = nlohmann::ordered_json;
using Property = std::pair<const char*, SchemaJson>;

SchemaJson plain_schema(const char* type) { return {{"type", type}}; }
SchemaJson number_schema() { return plain_schema("number"); }
SchemaJson integer_schema() { return plain_schema("integer"); }
SchemaJson string_schema() { return plain_schema("string"); }
SchemaJson flag_schema() { return plain_schema("boolean"); }
SchemaJson array_schema(const SchemaJson& items) { return {{"type", "array"}, {"items", items}}; }

SchemaJson object_schema(std::initializer_list<Property> properties) {
  SchemaJson object = {{"type", "object"}, {"properties", SchemaJson::object()}};
  for (const auto& [name, schema] : properties) object["properties"][name] = schema;
  return object;
}

/// `time` or `duration`, by which clients know both.
SchemaJson moment_schema(const char* title) {
  SchemaJson time = object_schema({{"sec", integer_schema()}, {"nsec", integer_schema()}});
  time["title"] = title;
  return time;
}

SchemaJson vector_schema() {
  return object_schema({{"x", number_schema()}, {"y", number_schema()}, {"z", number_schema()}});
}
SchemaJson quaternion_schema() {
  return object_schema({{"x", number_schema()},
                        {"y", number_schema()},
                        {"z", number_schema()},
                        {"w", number_schema()}});
}
SchemaJson pose_schema() {
  return object_schema({{"position", vector_schema()}, {"orientation", quaternion_schema()}});
}
SchemaJson colour_schema() {
  return object_schema({{"r", number_schema()},
                        {"g", number_schema()},
                        {"b", number_schema()},
                        {"a", number_schema()}});
}

std::string titled_schema(const char* title, SchemaJson schema) {
  schema["title"] = title;
  return schema.dump();
}

SchemaJson entity_schema() {
  const SchemaJson cube = object_schema(
      {{"pose", pose_schema()}, {"size", vector_schema()}, {"color", colour_schema()}});
  const SchemaJson cylinder = object_schema({{"pose", pose_schema()},
                                             {"size", vector_schema()},
                                             {"bottom_scale", number_schema()},
                                             {"top_scale", number_schema()},
                                             {"color", colour_schema()}});
  const SchemaJson triangles = object_schema({{"pose", pose_schema()},
                                              {"points", array_schema(vector_schema())},
                                              {"color", colour_schema()},
                                              {"colors", array_schema(colour_schema())},
                                              {"indices", array_schema(integer_schema())}});
  const SchemaJson arrow = object_schema({{"pose", pose_schema()},
                                          {"shaft_length", number_schema()},
                                          {"shaft_diameter", number_schema()},
                                          {"head_length", number_schema()},
                                          {"head_diameter", number_schema()},
                                          {"color", colour_schema()}});
  const SchemaJson text = object_schema({{"pose", pose_schema()},
                                         {"billboard", flag_schema()},
                                         {"font_size", number_schema()},
                                         {"scale_invariant", flag_schema()},
                                         {"color", colour_schema()},
                                         {"text", string_schema()}});
  return object_schema({{"timestamp", moment_schema("time")},
                        {"frame_id", string_schema()},
                        {"id", string_schema()},
                        {"lifetime", moment_schema("duration")},
                        {"frame_locked", flag_schema()},
                        {"metadata", array_schema(object_schema(
                                         {{"key", string_schema()}, {"value", string_schema()}}))},
                        {"arrows", array_schema(arrow)},
                        {"cubes", array_schema(cube)},
                        // A sphere has the same fields as a cube.
                        {"spheres", array_schema(cube)},
                        {"cylinders", array_schema(cylinder)},
                        // Never filled, so the items of lines and models stay undescribed.
                        {"lines", array_schema(object_schema({}))},
                        {"triangles", array_schema(triangles)},
                        {"texts", array_schema(text)},
                        {"models", array_schema(object_schema({}))}});
}

}  // namespace

const std::string& scene_update_schema() {
  static const std::string kSchema = titled_schema(
      "foxglove.SceneUpdate",
      object_schema({{"deletions", array_schema(object_schema({{"timestamp", moment_schema("time")},
                                                               {"type", integer_schema()},
                                                               {"id", string_schema()}}))},
                     {"entities", array_schema(entity_schema())}}));
  return kSchema;
}

const std::string& frame_transforms_schema() {
  static const std::string kSchema = titled_schema(
      "foxglove.FrameTransforms",
      object_schema(
          {{"transforms", array_schema(object_schema({{"timestamp", moment_schema("time")},
                                                      {"parent_frame_id", string_schema()},
                                                      {"child_frame_id", string_schema()},
                                                      {"translation", vector_schema()},
                                                      {"rotation", quaternion_schema()}}))}}));
  return kSchema;
}

const std::string& point_cloud_schema() {
  static const std::string kSchema = [] {
    SchemaJson bytes = string_schema();
    // By this a client knows that the text is binary data.
    bytes["contentEncoding"] = "base64";
    return titled_schema(
        "foxglove.PointCloud",
        object_schema({{"timestamp", moment_schema("time")},
                       {"frame_id", string_schema()},
                       {"pose", pose_schema()},
                       {"point_stride", integer_schema()},
                       {"fields", array_schema(object_schema({{"name", string_schema()},
                                                              {"offset", integer_schema()},
                                                              {"type", integer_schema()}}))},
                       {"data", bytes}}));
  }();
  return kSchema;
}

const std::string& log_schema() {
  static const std::string kSchema =
      titled_schema("foxglove.Log", object_schema({{"timestamp", moment_schema("time")},
                                                   {"level", integer_schema()},
                                                   {"message", string_schema()},
                                                   {"name", string_schema()},
                                                   {"file", string_schema()},
                                                   {"line", integer_schema()}}));
  return kSchema;
}

const std::string& poses_schema() {
  static const std::string kSchema = titled_schema(
      // Types of our own: clients show them as plain data, in tables and plots.
      "rave.Poses",
      object_schema({{"timestamp", moment_schema("time")},
                     {"robots", array_schema(object_schema({{"name", string_schema()},
                                                            {"x_m", number_schema()},
                                                            {"y_m", number_schema()},
                                                            {"yaw_rad", number_schema()},
                                                            {"speed_mps", number_schema()},
                                                            {"known", flag_schema()},
                                                            {"stale", flag_schema()},
                                                            {"stopped", flag_schema()},
                                                            {"real", flag_schema()},
                                                            {"touching", flag_schema()}}))}}));
  return kSchema;
}

const std::string& run_schema() {
  static const std::string kSchema =
      titled_schema("rave.Run", object_schema({{"timestamp", moment_schema("time")},
                                               {"time_s", number_schema()},
                                               {"state", string_schema()},
                                               {"pace", number_schema()},
                                               {"speed", number_schema()}}));
  return kSchema;
}

}  // namespace rave::gui_server
