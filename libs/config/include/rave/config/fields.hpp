// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "rave/base/file.hpp"
#include "rave/base/result.hpp"
#include "rave/config/codecs.hpp"
#include "rave/config/diagnostics.hpp"
#include "rave/config/located.hpp"
#include "rave/config/raw_node.hpp"
#include "rave/config/visitors.hpp"
#include "rave/config/yaml.hpp"

// A struct is described once, in its own namespace, and that description reads it from YAML, writes
// it with all defaults, and gives its JSON Schema:
//
//   struct Laser { double range_m = 8; std::string frame; std::optional<double> fov_deg; };
//   template <class V> void describe(V& v, Laser& c) {
//     v.field("range_m", c.range_m, {.doc = "Farthest reading.", .min = 0, .unit = "m"});
//     v.required("frame", c.frame, {.doc = "Where it is mounted."});
//     v.field("fov_deg", c.fov_deg, {.min = 0, .max = 360, .unit = "deg"});
//   }
//
// Optional, also found by argument-dependent lookup:
//   Status validate(const Laser&);                      an error without a place gets the mapping's
//   void validate(const Laser&, config::CheckContext&); may report several, each at its key
//   Status read_shorthand(const config::RawNode&, Laser&);   called for a value that is no mapping
//
// Types: bool, integers, double, std::string, enums (see EnumTag), described structs, RawNode, and
// optional, vector, array, map<std::string, …> and Located of these. An optional is unset by
// leaving it out or by `null`. A struct may not contain itself.
namespace rave::config {

/// Reads a described struct from a parsed tree. Errors are added to the diagnostics; the value is
/// complete only if none was added.
template <class T>
[[nodiscard]] T read_node(const RawNode& node, Diagnostics& diagnostics) {
  T value{};
  const FieldOptions options;
  Codec<T>::read(ReadContext{diagnostics, options, {}}, node, value);
  return value;
}

/// Like read_node(), with all errors joined into one.
template <class T>
[[nodiscard]] Result<T> read_node(const RawNode& node) {
  Diagnostics diagnostics;
  T value = read_node<T>(node, diagnostics);
  if (diagnostics.ok()) return value;
  diagnostics.sort();
  return tl::unexpected<Error>(diagnostics.joined());
}

/// Reads a struct from YAML text. `file_name` is used in messages only. On failure the diagnostics
/// hold every error found, sorted by place; the Error joins the first of them.
template <class T>
[[nodiscard]] Result<T> read_text(std::string_view text, std::string_view file_name,
                                  Diagnostics& diagnostics) {
  T value{};
  if (const auto node = parse_yaml(text, file_name, diagnostics)) {
    value = read_node<T>(*node, diagnostics);
  }
  if (diagnostics.ok()) return value;
  diagnostics.sort();
  return tl::unexpected<Error>(diagnostics.joined());
}

template <class T>
[[nodiscard]] Result<T> read_text(std::string_view text, std::string_view file_name) {
  Diagnostics diagnostics;
  return read_text<T>(text, file_name, diagnostics);
}

/// Reads a struct from a YAML file of at most kMaxFileBytes. Errors: those of rave::read_file, and
/// kParse with file:line:column for errors in its content.
template <class T>
[[nodiscard]] Result<T> read_file(const std::filesystem::path& path) {
  RAVE_TRY_ASSIGN(const std::string text, rave::read_file(path, kMaxFileBytes));
  return read_text<T>(text, path.string());
}

/// The struct as a tree with all fields.
template <class T>
[[nodiscard]] RawNode write_node(const T& value) {
  return Codec<T>::write(value);
}

/// The struct as YAML with all fields; units and doc sentences become comments. Reading it back
/// gives an equal struct.
template <class T>
[[nodiscard]] std::string write_text(const T& value) {
  return to_yaml(write_node(value));
}

/// The JSON Schema (draft 07) of the files that read_text<T> accepts. `id` becomes `$id`.
template <class T>
[[nodiscard]] std::string json_schema(std::string_view title, std::string_view id) {
  RawNode schema = RawNode::mapping();
  schema.append("$schema", RawNode::text("http://json-schema.org/draft-07/schema#"));
  schema.append("$id", RawNode::text(std::string(id)));
  schema.append("title", RawNode::text(std::string(title)));
  const RawNode body = Codec<T>::schema(FieldOptions{});
  for (std::size_t i = 0; i < body.size(); ++i) schema.append(body.key(i), body.child(i));
  return to_json(schema);
}

}  // namespace rave::config
