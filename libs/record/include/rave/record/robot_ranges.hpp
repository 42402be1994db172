// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::record {

/// Ids of robots as text: `0-9,12`. The input may be in any order, without duplicates.
[[nodiscard]] std::string robot_ranges(std::vector<std::uint32_t> robots);

/// The inverse of robot_ranges(), ascending. Errors: kParse (wrong syntax, or an id that is not
/// below `count`).
[[nodiscard]] Result<std::vector<std::uint32_t>> parse_robot_ranges(std::string_view text,
                                                                    std::uint32_t count);

}  // namespace rave::record
