// SPDX-License-Identifier: Apache-2.0
#include "foxglove/foxglove_schemas.hpp"

#include <map>
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

/// An object of numbers.
SchemaJson numbers_schema(std::initializer_list<const char*> names) {
  SchemaJson object = object_schema({});
  for (const char* const name : names) object["properties"][name] = number_schema();
  return object;
}

SchemaJson vector_schema() { return numbers_schema({"x", "y", "z"}); }
SchemaJson quaternion_schema() { return numbers_schema({"x", "y", "z", "w"}); }
SchemaJson colour_schema() { return numbers_schema({"r", "g", "b", "a"}); }
SchemaJson pose_schema() {
  return object_schema({{"position", vector_schema()}, {"orientation", quaternion_schema()}});
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

SchemaJson point_cloud_schema() {
  SchemaJson bytes = string_schema();
  // By this a client knows that the text is binary data.
  bytes["contentEncoding"] = "base64";
  return object_schema({{"timestamp", moment_schema("time")},
                        {"frame_id", string_schema()},
                        {"pose", pose_schema()},
                        {"point_stride", integer_schema()},
                        {"fields", array_schema(object_schema({{"name", string_schema()},
                                                               {"offset", integer_schema()},
                                                               {"type", integer_schema()}}))},
                        {"data", bytes}});
}

/// By title.
std::map<std::string_view, std::string> all_schemas() {
  std::map<std::string_view, SchemaJson> schemas;
  schemas["foxglove.SceneUpdate"] =
      object_schema({{"deletions", array_schema(object_schema({{"timestamp", moment_schema("time")},
                                                               {"type", integer_schema()},
                                                               {"id", string_schema()}}))},
                     {"entities", array_schema(entity_schema())}});
  schemas["foxglove.FrameTransforms"] = object_schema(
      {{"transforms", array_schema(object_schema({{"timestamp", moment_schema("time")},
                                                  {"parent_frame_id", string_schema()},
                                                  {"child_frame_id", string_schema()},
                                                  {"translation", vector_schema()},
                                                  {"rotation", quaternion_schema()}}))}});
  schemas["foxglove.PointCloud"] = point_cloud_schema();
  schemas["foxglove.Log"] = object_schema({{"timestamp", moment_schema("time")},
                                           {"level", integer_schema()},
                                           {"message", string_schema()},
                                           {"name", string_schema()},
                                           {"file", string_schema()},
                                           {"line", integer_schema()}});
  // Types of our own: clients show them as plain data, in tables and plots.
  schemas["rave.Poses"] =
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
                                                            {"touching", flag_schema()}}))}});
  schemas["rave.Run"] = object_schema({{"timestamp", moment_schema("time")},
                                       {"time_s", number_schema()},
                                       {"state", string_schema()},
                                       {"pace", number_schema()},
                                       {"speed", number_schema()}});
  std::map<std::string_view, std::string> texts;
  for (auto& [title, schema] : schemas) {
    schema["title"] = title;
    texts[title] = schema.dump();
  }
  return texts;
}

}  // namespace

const std::string& foxglove_schema(std::string_view title) {
  static const auto kSchemas = all_schemas();
  return kSchemas.at(title);
}

}  // namespace rave::gui_server
