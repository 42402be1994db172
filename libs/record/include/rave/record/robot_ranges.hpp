// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::record {

/// Ids of robots as text: `0-9,12`. Any order, without repetition.
[[nodiscard]] std::string robot_ranges(std::vector<std::uint32_t> robots);

/// The ids again, ascending. Errors: kParse (not of that form, or an id of `count` and above).
[[nodiscard]] Result<std::vector<std::uint32_t>> parse_robot_ranges(std::string_view text,
                                                                    std::uint32_t count);

}  // namespace rave::record
