// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "near_lists.hpp"
#include "rave/sim/range_engine.hpp"

namespace rave::sim {

/// Lists for a sensor at each of `places_W`, carried by `owners`, what its fan could meet if
/// sensors and robots move by `margin_m` together: indexes of pieces, discs first and polygons
/// second. No allocation once as much has been listed before.
void list_near(const world::Snapshot& world, const FanTable& fan, double z_m,
               std::span<const RobotId> owners, std::span<const Vec2> places_W, double margin_m,
               FanScratch& scratch, NearLists& lists);

/// cast_fan() from `place` for one of the sensors that `lists` were made for and still hold for.
/// The same ranges.
void cast_fan(const world::Snapshot& world, const FanTable& fan, const SensorPlace& place,
              const NearLists& lists, std::size_t asker, FanScratch& scratch,
              std::span<float> ranges, std::span<std::uint32_t> bodies);

}  // namespace rave::sim
