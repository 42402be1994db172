// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/codec/raw_node.hpp"

namespace rave::codec {

/// YAML in block style with the comments of the entries; items of lists that are short mappings
/// without comments have one line each. config::parse_yaml() gives an equal node.
[[nodiscard]] std::string to_yaml(const RawNode& node);

/// JSON with an indent of two, keys in their order, and a final newline. Infinities become null.
[[nodiscard]] std::string to_json(const RawNode& node);
/// The same in one line, without a newline.
[[nodiscard]] std::string to_json_line(const RawNode& node);

}  // namespace rave::codec
