// SPDX-License-Identifier: Apache-2.0
#include "rave/direct_line/order_members.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace rave::direct_line {
namespace {

/// No robot is as fast, in m/s and in rad/s.
constexpr double kFastest = 100;

Result<std::vector<Vec2>> read_points(JsonMembers& members, OrderKind kind, std::size_t robots) {
  // A path too long for any run gets the error message that a run would give.
  constexpr std::size_t kMostRead = 100'000;
  RAVE_TRY_ASSIGN(auto points, members.list("points", kMostRead, point_of));
  if (kind == OrderKind::kPath) {
    RAVE_TRY(request::check_path_size(points.size()));
    return points;
  }
  // Several robots may drive to one goal, but cannot be placed at one point.
  const bool one = points.size() == 1 && kind == OrderKind::kGoal;
  if (one || points.size() == robots) return points;
  return fail(ErrorCode::kParse, "`points`: expected one for each robot, {}", robots);
}

/// All four or none.
Status read_pedals(JsonMembers& members, request::Pedals& pedals) {
  RAVE_TRY_ASSIGN(pedals.steering, members.number_in("steering", -1, 1));
  RAVE_TRY_ASSIGN(pedals.throttle, members.number_in("throttle", 0, 1));
  RAVE_TRY_ASSIGN(pedals.brake, members.number_in("brake", 0, 1));
  RAVE_TRY_ASSIGN(pedals.gear, members.number_in("gear", -1, 1));
  if (pedals.is_valid()) return {};
  return fail(ErrorCode::kParse, "`gear`: expected -1, 0 or 1");
}

}  // namespace

Result<Vec2> point_of(const Json& pair, const char* name) {
  // JSON has no NaN, and a number that overflows is no JSON for the parser: the bound refuses the
  // rest.
  const bool good = pair.is_array() && pair.size() == 2 && pair[0].is_number() &&
                    pair[1].is_number() && std::abs(pair[0].get<double>()) <= kFarthest_m &&
                    std::abs(pair[1].get<double>()) <= kFarthest_m;
  if (good) return Vec2{pair[0].get<double>(), pair[1].get<double>()};
  return fail(ErrorCode::kParse, "`{}`: expected pairs of x and y in metres, within ±{} m", name,
              kFarthest_m);
}

Result<ReadOrder> read_order(JsonMembers& members, OrderKind kind, std::size_t robots) {
  request::OrderParts parts;
  std::vector<Vec2> points;
  std::string text;
  if (kind == OrderKind::kDrive) {
    RAVE_TRY_ASSIGN(parts.v_mps, members.number_in("v", -kFastest, kFastest));
    RAVE_TRY_ASSIGN(parts.w_radps, members.number_in("w", -kFastest, kFastest));
    if (members.has("vy")) {
      RAVE_TRY_ASSIGN(parts.vy_mps, members.number_in("vy", -kFastest, kFastest));
    }
    if (members.has("throttle")) {
      RAVE_TRY(read_pedals(members, parts.pedals.emplace()));
    }
  } else if (kind == OrderKind::kText) {
    RAVE_TRY_ASSIGN(text, members.text("text", kLongestText, true));
    if (text.empty()) return fail(ErrorCode::kParse, "`text`: expected text");
    parts.text = text;
  }
  const bool drives = kind == OrderKind::kGoal || kind == OrderKind::kPath;
  if (drives || kind == OrderKind::kPlace) {
    RAVE_TRY_ASSIGN(points, read_points(members, kind, robots));
    parts.points_W = points;
    if (kind != OrderKind::kPath && members.has("yaw")) {
      constexpr double kTurn_rad = 2 * std::numbers::pi;
      RAVE_TRY_ASSIGN(parts.yaw_rad, members.number_in("yaw", -kTurn_rad, kTurn_rad));
    }
  }
  // 0 means "not given". A path is driven forwards, so a negative speed has no meaning.
  if (drives && members.has("speed")) {
    RAVE_TRY_ASSIGN(parts.speed_mps, members.number_in("speed", 0, kFastest));
  }
  const bool several = kind != OrderKind::kPath && points.size() > 1;
  if (several) parts.points_W = parts.points_W.first(1);
  RAVE_TRY_ASSIGN(auto order, request::make_order(kind, parts));
  if (!several) points.clear();
  return ReadOrder{std::move(order), std::move(points)};
}

}  // namespace rave::direct_line
