// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/codec/raw_node.hpp"

namespace rave::codec {

/// Limits that bound the cost of a malicious text.
struct JsonLimits {
  std::size_t depth = 16;       ///< Nesting of lists and objects.
  std::size_t nodes = 100'000;  ///< Values and keys.
};

/// Parses one JSON value, strictly (RFC 8259). Errors kParse: no JSON, a key twice in one object, a
/// number that overflows, a text that is not UTF-8 or has a character 0, too deep, too many values.
/// The nodes have no places: messages about them name the key.
[[nodiscard]] Result<RawNode> parse_json(std::string_view text, const JsonLimits& limits = {});

}  // namespace rave::codec
