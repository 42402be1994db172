// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "rave/config/diagnostics.hpp"
#include "rave/config/raw_node.hpp"

namespace rave::config {

/// Values for the names that stand as `$(name)` in a robot file. Each is a scalar and keeps its
/// place.
using Variables = std::map<std::string, RawNode>;

/// Replaces `$(name)` in every scalar of a robot file's tree. What may stand there is declared with
/// its default in the tree's `variables:` mapping; `given` overrides these defaults, and the
/// mapping then holds the values in force. A scalar that is `$(name)` and nothing else takes the
/// type of the value; inside of a longer text the value is inserted as text. `$$(` stands for `$(`.
/// Replaced scalars keep the place of the scalar that they replace. Errors: a name that is not
/// declared (at the scalar, or at the given value), a value that is no scalar, an unclosed `$(`.
void substitute_variables(RawNode& robot, const Variables& given, Diagnostics& diagnostics);

/// Writes `$(` in every text as `$$(`, so that substitute_variables gives the tree back.
void escape_variables(RawNode& node);

}  // namespace rave::config
