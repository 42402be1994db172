// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/names.hpp"
#include "rave/config/field_options.hpp"
#include "rave/config/raw_node.hpp"

namespace rave::config {

/// A key that a mapping may have, and the unit of its value.
struct KnownKey {
  std::string_view name;
  std::string_view unit;
};

/// The message for an unknown key.
[[nodiscard]] std::string unknown_key_message(std::string_view key,
                                              std::span<const KnownKey> known);

/// The comment of a written field: `[m] Sentence.`
[[nodiscard]] std::string field_comment(std::string_view doc, std::string_view unit);

/// A schema with its description first and the default, if any, last.
[[nodiscard]] RawNode annotated_schema(const RawNode& schema, std::string_view doc,
                                       std::string_view unit, const RawNode* initial);

/// The schema of a mapping with exactly these properties.
[[nodiscard]] RawNode object_schema(RawNode properties, RawNode required);

}  // namespace rave::config
