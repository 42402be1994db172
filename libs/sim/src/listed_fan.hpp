// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "block_kernel.hpp"
#include "near_lists.hpp"
#include "rave/sim/range_engine.hpp"

namespace rave::sim {

/// Lists for a sensor at each of `places_W`, carried by `owners`, what its fan could meet if
/// sensors and robots move by `margin_m` together: indexes of pieces, discs first and polygons
/// second. No allocation once as much has been listed before.
void list_near(const world::Snapshot& world, const FanTable& fan, double z_m,
               std::span<const RobotId> owners, std::span<const Vec2> places_W, double margin_m,
               FanScratch& scratch, NearLists& lists);

/// Pieces that the sensors of a block could meet.
struct BlockCandidates {
  std::vector<const world::ShapePiece*> pieces;  ///< Room for more than there are.
  std::vector<std::uint16_t> askers;             ///< Whose each is.
  std::size_t count = 0;

  /// None, with room for `most` and one more.
  void clear(std::size_t most) {
    if (pieces.size() <= most) {
      pieces.resize(most + 1);
      askers.resize(most + 1);
    }
    count = 0;
  }
  [[nodiscard]] SeenBy seen_by() const noexcept { return {{pieces.data(), count}, askers.data()}; }
};

/// What casting the fans of a block needs; kept between calls so that nothing is allocated.
struct BlockScratch {
  BlockCandidates discs;
  BlockCandidates polygons;
  std::vector<FanPlace> places;
  std::vector<float> inverse;  ///< As FanScratch has them, of each sensor.
  std::vector<std::uint32_t> body;
};

/// cast_fan() for the sensors that `lists` were made for and still hold for, which stand at
/// `places` now. Those of few rays are cast together, here; those of many rays one by one, when
/// they are read. The same ranges. What it is given has to outlive it.
class ListedFans {
 public:
  ListedFans(const world::Snapshot& world, const FanTable& fan, const NearLists& lists,
             std::span<const SensorPlace> places, FanScratch& scratch, BlockScratch& block);
  /// As cast_fan() gives them. Each sensor at most once.
  void read(std::size_t asker, std::span<float> ranges, std::span<std::uint32_t> bodies);

 private:
  void cast_together();
  void forget_chosen();
  void choose_for(std::size_t asker);

  const world::Snapshot* world_;
  const FanTable* fan_;
  const NearLists* lists_;
  std::span<const SensorPlace> places_;
  FanScratch* scratch_;
  BlockScratch* block_;
};

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
