// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "rave/config/diagnostics.hpp"
#include "rave/config/raw_node.hpp"

namespace rave::config {

/// Limits that keep a hostile file from costing more than a moment.
inline constexpr std::size_t kMaxFileBytes = std::size_t{16} << 20;
inline constexpr std::size_t kMaxNodes = 1'000'000;  ///< After aliases are expanded.
inline constexpr int kMaxDepth = 64;                 ///< Of lists and mappings in one another.
inline constexpr std::size_t kMaxKeyBytes = 200;

/// Parses one YAML document. Aliases are expanded; tags, merge keys, keys that are not texts,
/// duplicate keys, a second document, an empty document, control characters and bytes that are not
/// UTF-8 are errors. Columns count bytes from 1. Returns nothing if there is no usable tree; after
/// duplicate keys the tree (with the first of them) is still returned so that reading can go on to
/// find further errors.
[[nodiscard]] std::optional<RawNode> parse_yaml(std::string_view text, std::string_view file_name,
                                                Diagnostics& diagnostics);

/// YAML in block style with the comments of the entries; parse_yaml of it gives an equal node.
[[nodiscard]] std::string to_yaml(const RawNode& node);

/// JSON, indented by two, keys in their order, ending in a newline. Infinities become null.
[[nodiscard]] std::string to_json(const RawNode& node);

}  // namespace rave::config
