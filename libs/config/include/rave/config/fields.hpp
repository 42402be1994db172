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
//   void validate(const Laser&, config::CheckContext&); may report several errors, each at its key
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
  return diagnostics.value_or_errors(std::move(value));
}

/// Reads a struct from YAML text. `file_name` is used in messages only. `prepare` may change the
/// tree before it is read, and adds its errors to the diagnostics. The Error joins all errors
/// found.
template <class T, class Prepare>
[[nodiscard]] Result<T> read_text(std::string_view text, std::string_view file_name,
                                  Prepare&& prepare) {
  Diagnostics diagnostics;
  T value{};
  if (auto tree = parse_yaml(text, file_name, diagnostics)) {
    const std::size_t errors_before = diagnostics.size();
    prepare(*tree, diagnostics);
    // Skipped after an error: what could not be prepared would be reported again.
    if (diagnostics.size() == errors_before) value = read_node<T>(*tree, diagnostics);
  }
  return diagnostics.value_or_errors(std::move(value));
}

template <class T>
[[nodiscard]] Result<T> read_text(std::string_view text, std::string_view file_name) {
  return read_text<T>(text, file_name, [](RawNode& /*tree*/, Diagnostics& /*diagnostics*/) {});
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

/// The JSON Schema (draft 07) of files with this content, such as `Codec<T>::schema({})`. `id`
/// becomes `$id`.
[[nodiscard]] std::string json_schema(const RawNode& body, std::string_view title,
                                      std::string_view id);

}  // namespace rave::config
