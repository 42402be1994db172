// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "rave/config/described.hpp"

namespace rave::config {

/// Values of the names that appear as `$(name)` in a robot file. Each is a scalar and keeps its
/// place.
using Variables = std::map<std::string, RawNode>;

/// Replaces `$(name)` in every scalar of a robot file's tree. The tree's mapping `variables:`
/// declares the names and their defaults; `given` overrides these, and the mapping then holds the
/// values used. A scalar that consists of `$(name)` alone takes the type of the value; inside a
/// longer text the value is inserted as text. `$$(` stands for `$(`. Replaced scalars keep their
/// place. Errors: an undeclared name (at the scalar, or at the given value), a value that is not a
/// scalar, an unclosed `$(`.
void substitute_variables(RawNode& robot, const Variables& given, Diagnostics& diagnostics);

/// Replaces `$(` in every text by `$$(`. substitute_variables() undoes it.
void escape_variables(RawNode& node);

}  // namespace rave::config
