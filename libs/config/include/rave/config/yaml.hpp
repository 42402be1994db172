// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "rave/config/described.hpp"

namespace rave::config {

/// Limits that bound the cost of parsing a malicious file.
inline constexpr std::size_t kMaxFileBytes = std::size_t{64} << 20;
/// Enough for 100 000 obstacles with all their keys.
inline constexpr std::size_t kMaxNodes = 4'000'000;
inline constexpr std::size_t kMaxCopies = 1'000'000;  ///< Of values that aliases stand for.
inline constexpr int kMaxDepth = 64;                  ///< Nesting of lists and mappings.
inline constexpr std::size_t kMaxKeyBytes = 200;

/// Parses one YAML document. Aliases are expanded. Errors: tags, merge keys, keys that are not
/// texts, duplicate keys, a second document, an empty document, control characters and invalid
/// UTF-8. Columns count bytes from 1. Returns nothing if there is no usable tree. After duplicate
/// keys it returns the tree with the first of each, so that the caller can find further errors.
[[nodiscard]] std::optional<RawNode> parse_yaml(std::string_view text, std::string_view file_name,
                                                Diagnostics& diagnostics);

}  // namespace rave::config
