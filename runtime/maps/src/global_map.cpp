// SPDX-License-Identifier: Apache-2.0
#include "rave/maps/global_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "rave/math/exponential.hpp"

namespace rave::maps {
namespace {

/// Log odds of a probability in percent.
double log_odds(double percent) {
  const double p = std::clamp(percent, 1.0, 99.0);
  return log(p / (100 - p));
}

double known_log_odds(std::uint8_t percent) {
  static const std::array<double, 101> kTable = [] {
    std::array<double, 101> table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = log_odds(static_cast<double>(i));
    return table;
  }();
  return kTable[std::min<std::size_t>(percent, 100)];
}

/// Percent of the log odds `prior + sum`.
std::uint8_t percent_of(double log_odds_all) {
  return static_cast<std::uint8_t>(std::lround(100 / (1 + exp(-log_odds_all))));
}

/// What is known of one cell.
struct Belief {
  double before = 0;
  double sum = before;
  bool known = false;

  void add(std::uint8_t cell) {
    if (cell == kUnknown) return;
    known = true;
    sum += known_log_odds(cell) - before;
  }
  [[nodiscard]] std::uint8_t cell() const { return known ? percent_of(sum) : kUnknown; }
};

}  // namespace

std::uint8_t combined(const std::vector<std::uint8_t>& cells, double prior) {
  Belief belief{log_odds(prior)};
  for (const std::uint8_t cell : cells) belief.add(cell);
  return belief.cell();
}

Status GlobalMap::add(const MapTile& tile) {
  const double tile_m = kTileCells * tile.frame.resolution_m;
  if (resolution_m_ == 0) {
    resolution_m_ = tile.frame.resolution_m;
    phase_W_ = tile.frame.origin_W;
  }
  if (tile.frame.resolution_m != resolution_m_) {
    return fail(ErrorCode::kInvalidArgument,
                "the map of {} has cells of {} m and others have cells of {} m; they cannot be "
                "combined",
                tile.source, tile.frame.resolution_m, resolution_m_);
  }
  const Vec2 off = (1 / tile_m) * (tile.frame.origin_W - phase_W_);
  const Vec2 whole{std::round(off.x), std::round(off.y)};
  // A thousandth of a tile is less than a tenth of a cell.
  if (!(squared_norm(off - whole) < 1e-6)) {
    return fail(ErrorCode::kInvalidArgument,
                "the cells of the map of {} are not in line with those of others; they cannot be "
                "combined",
                tile.source);
  }
  const Where first{static_cast<std::int64_t>(whole.y), static_cast<std::int64_t>(whole.x)};
  const auto tiles_along = [](std::uint32_t cells) {
    return (cells + kTileCells - 1) / kTileCells;
  };
  if (tile.cells.size() != std::size_t{kTileCells} * kTileCells) {
    return fail(ErrorCode::kInvalidArgument, "a tile of the map of {} is not of {} x {} cells",
                tile.source, kTileCells, kTileCells);
  }
  grow(first, {first.first + tiles_along(tile.frame.rows),
               first.second + tiles_along(tile.frame.columns)});
  Place& place = places_[{first.first + tile.row, first.second + tile.column}];
  Local& local = place.locals[tile.robot];
  if (!local.cells.empty() && tile.stamp < local.stamp) return {};
  place.changed |= local.cells != tile.cells;
  local = {tile.stamp, tile.cells};
  return {};
}

void GlobalMap::grow(const Where& low, const Where& high) {
  const bool first = low_ == high_;
  const Where low_now =
      first ? low : Where{std::min(low.first, low_.first), std::min(low.second, low_.second)};
  const Where high_now =
      first ? high : Where{std::max(high.first, high_.first), std::max(high.second, high_.second)};
  if (low_now == low_ && high_now == high_) return;
  low_ = low_now;
  high_ = high_now;
  for (auto& [where, place] : places_) place.changed = true;
}

MapTile GlobalMap::tile_at(const Where& where, const Place& place) const {
  const double tile_m = kTileCells * resolution_m_;
  MapTile tile;
  tile.source = name_;
  tile.frame = {
      resolution_m_,
      phase_W_ + tile_m * Vec2{static_cast<double>(low_.second), static_cast<double>(low_.first)},
      static_cast<std::uint32_t>(high_.second - low_.second) * kTileCells,
      static_cast<std::uint32_t>(high_.first - low_.first) * kTileCells};
  tile.column = static_cast<std::uint32_t>(where.second - low_.second);
  tile.row = static_cast<std::uint32_t>(where.first - low_.first);
  tile.revision = place.revision;
  tile.cells.resize(std::size_t{kTileCells} * kTileCells);
  for (const auto& [robot, local] : place.locals) tile.stamp = std::max(tile.stamp, local.stamp);
  const double before = log_odds(prior_);
  for (std::size_t i = 0; i < tile.cells.size(); ++i) {
    Belief belief{before};
    for (const auto& [robot, local] : place.locals) belief.add(local.cells[i]);
    tile.cells[i] = belief.cell();
  }
  return tile;
}

std::vector<MapTile> GlobalMap::changed() {
  std::vector<MapTile> tiles;
  for (auto& [where, place] : places_) {
    if (!place.changed) continue;
    place.changed = false;
    ++place.revision;
    tiles.push_back(tile_at(where, place));
  }
  return tiles;
}

std::vector<MapTile> GlobalMap::tiles() const {
  std::vector<MapTile> tiles;
  for (const auto& [where, place] : places_) tiles.push_back(tile_at(where, place));
  return tiles;
}

}  // namespace rave::maps
