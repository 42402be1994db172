// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <vector>

#include "room.hpp"

namespace peer {

/// One scan of a ScipDevice at a place of a room, as if all of it was measured at once: millimetres
/// for each step from the first to the last, with Gaussian noise. Too far away: error code 0.
[[nodiscard]] std::vector<int> scan_room(const Room& room, double x, double y, double yaw,
                                         double noise_mm, std::mt19937_64& random);

}  // namespace peer
