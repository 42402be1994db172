// SPDX-License-Identifier: Apache-2.0
#include "run/world_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "rave/math/transform.hpp"

namespace rave::gui_server {
namespace {

constexpr double kFinest_m = 0.05;
constexpr double kMostCells = 1024;
/// Free space around everything.
constexpr double kMargin_m = 0.5;
constexpr std::uint8_t kOccupied = 100;

/// A disc about its one corner, or a convex polygon; in the world.
struct Piece {
  std::vector<Vec2> corners;
  double radius_m = 0;
};

struct Box {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void hold(const Piece& piece) {
    for (const Vec2& p : piece.corners) {
      low = {std::min(low.x, p.x - piece.radius_m), std::min(low.y, p.y - piece.radius_m)};
      high = {std::max(high.x, p.x + piece.radius_m), std::max(high.y, p.y + piece.radius_m)};
    }
  }
};

std::vector<Piece> pieces_of(const std::string& bodies_json) {
  std::vector<Piece> pieces;
  for (const auto& body : nlohmann::json::parse(bodies_json)) {
    // The map is that of what a real robot could sense.
    if (body.at("kind") == "virtual") continue;
    const auto& pose = body.at("pose");
    const Pose2 X_WB{pose[0].get<double>(), pose[1].get<double>(), pose[2].get<double>()};
    for (const auto& shape : body.at("shapes")) {
      Piece piece;
      if (shape.contains("disc")) {
        const auto& disc = shape.at("disc");
        piece.corners.push_back(
            transform(X_WB, Vec2{disc[0].get<double>(), disc[1].get<double>()}));
        piece.radius_m = disc[2].get<double>();
      } else {
        for (const auto& p : shape.at("polygon")) {
          piece.corners.push_back(transform(X_WB, Vec2{p[0].get<double>(), p[1].get<double>()}));
        }
      }
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

/// Whether a piece covers a cell about `p`, or a part of it; `half_m`: half of its side.
bool covers(const Piece& piece, Vec2 p, double half_m) {
  // A little more than a cell at the corners of its square, which does no harm on a map for people.
  if (piece.corners.size() == 1) {
    return std::hypot(p.x - piece.corners[0].x, p.y - piece.corners[0].y) <=
           piece.radius_m + half_m;
  }
  // Counterclockwise: inside is at the left of each edge. A wall that is thinner than a cell
  // counts.
  for (std::size_t i = 0; i < piece.corners.size(); ++i) {
    const Vec2 a = piece.corners[i];
    const Vec2 b = piece.corners[(i + 1) % piece.corners.size()];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const double left = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
    if (left < -half_m * length) return false;
  }
  return true;
}

/// The whole map, row by row.
struct Raster {
  maps::MapFrame frame;
  std::vector<std::uint8_t> cells;

  void draw(const Piece& piece) {
    Box box;
    box.hold(piece);
    const double cell_m = frame.resolution_m;
    const auto index = [cell_m](double at, double origin, std::uint32_t cells_along) {
      return static_cast<std::uint32_t>(std::clamp(std::floor((at - origin) / cell_m), 0.0,
                                                   static_cast<double>(cells_along - 1)));
    };
    const std::uint32_t x1 = index(box.high.x, frame.origin_W.x, frame.columns);
    const std::uint32_t y1 = index(box.high.y, frame.origin_W.y, frame.rows);
    for (std::uint32_t y = index(box.low.y, frame.origin_W.y, frame.rows); y <= y1; ++y) {
      for (std::uint32_t x = index(box.low.x, frame.origin_W.x, frame.columns); x <= x1; ++x) {
        const Vec2 p{frame.origin_W.x + (x + 0.5) * cell_m, frame.origin_W.y + (y + 0.5) * cell_m};
        if (covers(piece, p, 0.5 * cell_m)) {
          cells[std::size_t{y} * frame.columns + x] = kOccupied;
        }
      }
    }
  }
};

std::vector<maps::MapTile> tiles_of(const Raster& raster) {
  std::vector<maps::MapTile> tiles;
  const maps::MapFrame& frame = raster.frame;
  for (std::uint32_t row = 0; maps::MapFrame::side(frame.rows, row) > 0; ++row) {
    for (std::uint32_t column = 0; maps::MapFrame::side(frame.columns, column) > 0; ++column) {
      maps::MapTile tile{kWorldMap, maps::kNoRobot, frame, column, row, 1, {}, {}};
      const std::uint32_t width = maps::MapFrame::side(frame.columns, column);
      for (std::uint32_t y = 0; y < maps::MapFrame::side(frame.rows, row); ++y) {
        const auto first =
            raster.cells.begin() +
            static_cast<std::ptrdiff_t>(std::size_t{row * maps::kTileCells + y} * frame.columns +
                                        column * maps::kTileCells);
        tile.cells.insert(tile.cells.end(), first, first + width);
      }
      tiles.push_back(std::move(tile));
    }
  }
  return tiles;
}

}  // namespace

std::vector<maps::MapTile> world_map(const std::string& bodies_json) {
  const std::vector<Piece> pieces = pieces_of(bodies_json);
  Box box;
  for (const Piece& piece : pieces) box.hold(piece);
  if (!(box.low.x <= box.high.x)) return {};
  const double side_m = std::max(box.high.x - box.low.x, box.high.y - box.low.y) + 2 * kMargin_m;
  Raster raster;
  maps::MapFrame& frame = raster.frame;
  frame.resolution_m = kFinest_m;
  // Coarser for large worlds: the map goes to each page that looks at it.
  while (side_m / frame.resolution_m > kMostCells) frame.resolution_m *= 2;
  frame.origin_W = {box.low.x - kMargin_m, box.low.y - kMargin_m};
  const auto cells = [&](double low, double high) {
    return static_cast<std::uint32_t>(std::ceil((high - low + 2 * kMargin_m) / frame.resolution_m));
  };
  frame.columns = cells(box.low.x, box.high.x);
  frame.rows = cells(box.low.y, box.high.y);
  raster.cells.assign(std::size_t{frame.columns} * frame.rows, 0);
  for (const Piece& piece : pieces) raster.draw(piece);
  return tiles_of(raster);
}

}  // namespace rave::gui_server
