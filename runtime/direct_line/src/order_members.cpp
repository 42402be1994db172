// SPDX-License-Identifier: Apache-2.0
#include "rave/direct_line/order_members.hpp"

#include <cmath>
#include <numbers>

#include "rave/control/order_words.hpp"

namespace rave::direct_line {
namespace {

using Kind = runtime::RunRequest::Kind;

/// No robot is as fast, in m/s and in rad/s.
constexpr double kFastest = 100;

Status read_points(JsonMembers& members, std::size_t robots, runtime::RunRequest& request) {
  // A path too long for any run gets the error message that a run would give.
  constexpr std::size_t kMostRead = 100'000;
  RAVE_TRY_ASSIGN(request.points, members.list("points", kMostRead, point_of));
  if (request.kind == Kind::kPath) return runtime::check_path_size(request.points.size());
  // Several robots may drive to one goal, but cannot be placed at one point.
  const bool one = request.points.size() == 1 && request.kind == Kind::kGoal;
  if (!one && request.points.size() != robots) {
    return fail(ErrorCode::kParse, "`points`: expected one for each robot, {}", robots);
  }
  if (members.has("yaw")) {
    constexpr double kTurn_rad = 2 * std::numbers::pi;
    RAVE_TRY_ASSIGN(request.yaw_rad, members.number_in("yaw", -kTurn_rad, kTurn_rad));
  }
  return {};
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

Status read_order(JsonMembers& members, std::size_t robots, runtime::RunRequest& request) {
  if (request.kind == Kind::kDrive) {
    RAVE_TRY_ASSIGN(request.v_mps, members.number_in("v", -kFastest, kFastest));
    RAVE_TRY_ASSIGN(request.w_radps, members.number_in("w", -kFastest, kFastest));
  } else if (request.kind == Kind::kText) {
    RAVE_TRY_ASSIGN(request.value, members.text("text", kLongestText, true));
    if (request.value.empty()) return fail(ErrorCode::kParse, "`text`: expected text");
  }
  const bool drives = request.kind == Kind::kGoal || request.kind == Kind::kPath;
  if (drives || request.kind == Kind::kPlace) RAVE_TRY(read_points(members, robots, request));
  // 0 means "not given". A path is driven forwards, so a negative speed has no meaning.
  if (drives && members.has("speed")) {
    RAVE_TRY_ASSIGN(request.speed_mps, members.number_in("speed", 0, kFastest));
  }
  return {};
}

}  // namespace rave::direct_line
