// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "carmen/log.hpp"

namespace rave::carmen {

/// One sentence for each thing in a log that its user may not expect: rows of unknown messages,
/// rows that are refused, stamps out of order or of another clock, ranges that are no number, and
/// ranges taken for "no return". `path` names the log in them; `report` is that of the stream.
[[nodiscard]] std::vector<std::string> notes(const Log& log, std::string_view path,
                                             const recording::StreamReport& report);

}  // namespace rave::carmen
