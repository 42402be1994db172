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

/// The two ways of cast_fan(), with the same bits: to look for what is near all around, or beside
/// each ray, part by part, until it has met something. The latter for at most kMostWalked rays.
inline constexpr std::uint32_t kMostWalked = 16;
void cast_fan_around(const world::Snapshot& world, const FanTable& fan, const SensorPlace& place,
                     double z_m, BodyId owner, FanScratch& scratch, std::span<float> ranges,
                     std::span<std::uint32_t> bodies);
void cast_fan_along(const world::Snapshot& world, const FanTable& fan, const SensorPlace& place,
                    double z_m, BodyId owner, FanScratch& scratch, std::span<float> ranges,
                    std::span<std::uint32_t> bodies);
/// Whether the second is expected to take less time: for few rays and long ranges.
[[nodiscard]] bool walk_pays(const world::Snapshot& world, const FanTable& fan) noexcept;

}  // namespace rave::sim
