// SPDX-License-Identifier: Apache-2.0
#include "rave/results/map_result.hpp"

#include <algorithm>
#include <cmath>

#include "rave/maps/global_map.hpp"
#include "rave/math/transform.hpp"

namespace rave::runtime {
namespace {

constexpr double kNear_m = 0.1;
constexpr double kFarthest_m = 0.5;
constexpr std::uint8_t kFreeBelow = 35;
constexpr std::uint8_t kOccupiedAbove = 65;

/// The obstacles as shapes in the world.
class Truth {
 public:
  explicit Truth(const sim::EngineSpec& spec) {
    for (const world::Obstacle& obstacle : spec.world.obstacles) {
      if (obstacle.removed) continue;
      for (const world::Shape& shape : obstacle.body.shapes) add(shape, obstacle.X_WB);
    }
  }

  /// Distance of the nearest obstacle, 0 inside of one; at most kFarthest_m.
  [[nodiscard]] double distance_m(Vec2 p_W) const {
    double nearest_m = kFarthest_m;
    for (const Piece& piece : pieces_) {
      const double reach_m = piece.radius_m + nearest_m;
      if (squared_norm(piece.middle_W - p_W) > reach_m * reach_m) continue;
      nearest_m = std::min(nearest_m, piece_m(piece, p_W));
    }
    return nearest_m;
  }

 private:
  /// A disc, or a convex polygon within a disc.
  struct Piece {
    Vec2 middle_W;
    double radius_m = 0;
    std::vector<Vec2> corners_W;
  };

  void add(const world::Shape& shape, const Pose2& X_WB) {
    Piece piece{transform(X_WB, shape.centre), shape.radius_m, {}};
    if (!shape.vertices().empty()) {
      Vec2 sum;
      for (const Vec2 p_B : shape.vertices()) {
        piece.corners_W.push_back(transform(X_WB, p_B));
        sum = sum + piece.corners_W.back();
      }
      piece.middle_W = (1 / static_cast<double>(piece.corners_W.size())) * sum;
      piece.radius_m = 0;
      for (const Vec2 p_W : piece.corners_W) {
        piece.radius_m = std::max(piece.radius_m, std::sqrt(squared_norm(p_W - piece.middle_W)));
      }
    }
    pieces_.push_back(std::move(piece));
  }

  static double piece_m(const Piece& piece, Vec2 p_W) {
    if (piece.corners_W.empty()) {
      return std::max(0.0, std::sqrt(squared_norm(p_W - piece.middle_W)) - piece.radius_m);
    }
    bool inside = true;
    double nearest_m2 = kFarthest_m * kFarthest_m;
    for (std::size_t i = 0; i < piece.corners_W.size(); ++i) {
      const Vec2 a = piece.corners_W[i];
      const Vec2 along = piece.corners_W[(i + 1) % piece.corners_W.size()] - a;
      inside &= cross(along, p_W - a) >= 0;
      const double share = std::clamp(dot(p_W - a, along) / squared_norm(along), 0.0, 1.0);
      nearest_m2 = std::min(nearest_m2, squared_norm(p_W - (a + share * along)));
    }
    return inside ? 0 : std::sqrt(nearest_m2);
  }

  std::vector<Piece> pieces_;
};

void judge_cell(std::uint8_t cell, Vec2 p_W, const Truth& truth, MapAccuracy& accuracy) {
  if (cell == maps::kUnknown) {
    ++accuracy.unknown;
  } else if (cell < kFreeBelow) {
    ++accuracy.free;
    if (truth.distance_m(p_W) > 0) ++accuracy.free_right;
  } else if (cell > kOccupiedAbove) {
    ++accuracy.occupied;
    const double error_m = truth.distance_m(p_W);
    if (error_m <= kNear_m) ++accuracy.occupied_right;
    accuracy.wall_error_m += error_m;
  } else {
    ++accuracy.undecided;
  }
}

MapAccuracy judge(std::string name, const std::vector<maps::MapTile>& tiles, const Truth& truth) {
  MapAccuracy accuracy;
  accuracy.name = std::move(name);
  double cell_m = 0;
  for (const maps::MapTile& tile : tiles) {
    cell_m = tile.frame.resolution_m;
    for (std::uint32_t i = 0; i < tile.cells.size(); ++i) {
      const double x = tile.column * maps::kTileCells + i % maps::kTileCells + 0.5;
      const double y = tile.row * maps::kTileCells + i / maps::kTileCells + 0.5;
      judge_cell(tile.cells[i], tile.frame.origin_W + cell_m * Vec2{x, y}, truth, accuracy);
    }
  }
  if (accuracy.occupied > 0) accuracy.wall_error_m /= static_cast<double>(accuracy.occupied);
  const std::size_t known = accuracy.free + accuracy.occupied + accuracy.undecided;
  accuracy.known_m2 = static_cast<double>(known) * cell_m * cell_m;
  return accuracy;
}

}  // namespace

std::optional<MapResults> map_results(const sim::EngineSpec& spec, const RunFacts& facts) {
  if (facts.maps.empty()) return std::nullopt;
  const Truth truth(spec);
  MapResults results;
  results.cell_m = facts.maps.front().resolution_m;
  maps::GlobalMap global;
  for (auto at = facts.maps.begin(); at != facts.maps.end();) {
    const std::uint32_t robot = at->robot;
    std::vector<maps::MapTile> tiles;
    for (; at != facts.maps.end() && at->robot == robot; ++at) {
      tiles.push_back({spec.robots[robot].name,
                       robot,
                       {at->resolution_m, at->origin_W, at->columns, at->rows},
                       at->column,
                       at->row,
                       1,
                       SimTime{at->stamp_ns},
                       at->cells});
      if (const Status added = global.add(tiles.back()); !added) {
        results.problem = added.error().message;
      }
    }
    results.locals.push_back(judge(spec.robots[robot].name, tiles, truth));
    results.tiles.push_back(std::move(tiles));
  }
  if (results.problem.empty()) {
    results.global = judge("global", global.tiles(), truth);
    results.tiles.push_back(global.tiles());
  }
  return results;
}

}  // namespace rave::runtime
