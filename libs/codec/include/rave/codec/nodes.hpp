// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/codec/codecs.hpp"
#include "rave/codec/json_input.hpp"
#include "rave/codec/text_output.hpp"

// A struct is described once, in its own namespace, and that description reads it from YAML and
// JSON, writes it with all defaults, and gives its JSON Schema:
//
//   struct Laser { double range_m = 8; std::string frame; std::optional<double> fov_deg; };
//   template <class V> void describe(V& v, Laser& c) {
//     v.field("range_m", c.range_m, {.doc = "Farthest reading.", .min = 0, .unit = "m"});
//     v.required("frame", c.frame, {.doc = "Where it is mounted."});
//     v.field("fov_deg", c.fov_deg, {.min = 0, .max = 360, .unit = "deg"});
//   }
//
// Optional, also found by argument-dependent lookup:
//   void validate(const Laser&, codec::CheckContext&); may report several errors, each at its key
//
// Types: bool, integers, double, std::string, enums (see EnumTag), described structs, RawNode, and
// optional, vector, array, map<std::string, …>, Located and variant (see variant_codec.hpp) of
// these. An optional is unset by leaving it out or by `null`. A struct may not contain itself.
namespace rave::codec {

/// Reads a described value from a parsed tree. Errors are added to the diagnostics; the value is
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

/// The value as a tree with all fields.
template <class T>
[[nodiscard]] RawNode write_node(const T& value) {
  return Codec<T>::write(value);
}

/// Reads a described value from strict JSON. Errors: those of parse_json(), and kParse with the
/// name of the key, what was found and what was expected.
template <class T>
[[nodiscard]] Result<T> from_json(std::string_view text, const JsonLimits& limits = {}) {
  RAVE_TRY_ASSIGN(const RawNode node, parse_json(text, limits));
  return read_node<T>(node);
}

/// The value as JSON in one line, without a newline; from_json() gives an equal value.
template <class T>
[[nodiscard]] std::string to_json_line(const T& value) {
  return to_json_line(write_node(value));
}

/// The JSON Schema (draft 07) of files with this content, such as `Codec<T>::schema({})`. `id`
/// becomes `$id`.
[[nodiscard]] std::string json_schema(const RawNode& body, std::string_view title,
                                      std::string_view id);

}  // namespace rave::codec
