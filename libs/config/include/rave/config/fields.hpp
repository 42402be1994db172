// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "rave/base/file.hpp"
#include "rave/base/result.hpp"
#include "rave/config/described.hpp"
#include "rave/config/yaml.hpp"

// Described structs (rave/codec/nodes.hpp) as YAML files.
namespace rave::config {

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
    if (diagnostics.size() == errors_before) value = codec::read_node<T>(*tree, diagnostics);
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

/// The struct as YAML with all fields; units and doc sentences become comments. Reading it back
/// gives an equal struct.
template <class T>
[[nodiscard]] std::string write_text(const T& value) {
  return codec::to_yaml(codec::write_node(value));
}

}  // namespace rave::config
