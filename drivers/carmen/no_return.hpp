// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

namespace rave::carmen {

/// The range that a log writes for "no return", and how many rays have it.
struct NoReturn {
  float range_m = 0;
  std::size_t rays = 0;
  std::size_t of = 0;  ///< All rays.
};

/// Finds that range among those below `range_max_m`: lasers write their largest value for it, so it
/// is the largest one (at most one ray in a hundred of its number is longer), and it is far more
/// frequent than ranges of walls are. At least ten rays and one in a thousand have it, and three
/// times as many as have any other value of more than half of it. In published logs 2 to 3 % of
/// the rays are without return, and any other far value has less than a sixtieth of that number.
[[nodiscard]] std::optional<NoReturn> find_no_return(std::span<const float> ranges_m,
                                                     double range_max_m);

}  // namespace rave::carmen
