// SPDX-License-Identifier: Apache-2.0
#include "line_message.hpp"

#include <cmath>
#include <utility>

#include "json_members.hpp"
#include "rave/control/order_words.hpp"
#include "rave/direct_line/ticket.hpp"
#include "signed_text.hpp"

namespace rave::direct_line {
namespace {

using runtime::RunRequest;
using Kind = RunRequest::Kind;

constexpr std::size_t kLongestName = 256;
constexpr std::size_t kLongestProof = 128;
constexpr double kMostYaw_rad = 1000;

Result<double> number_within(JsonMembers& members, const char* name, double most) {
  RAVE_TRY_ASSIGN(const double value, members.number(name));
  if (std::abs(value) > most) {
    return fail(ErrorCode::kParse, "`{}`: expected {} to {}", name, -most, most);
  }
  return value;
}

Result<std::vector<Vec2>> points_of(JsonMembers& members, bool path) {
  RAVE_TRY_ASSIGN(const nlohmann::json* const value, members.any("points"));
  if (!value->is_array()) return fail(ErrorCode::kParse, "`points`: expected a list");
  if (path) RAVE_TRY(runtime::check_path_size(value->size()));
  if (!path && value->size() != 1) return fail(ErrorCode::kParse, "`points`: expected one point");
  std::vector<Vec2> points;
  for (const nlohmann::json& pair : *value) {
    if (!pair.is_array() || pair.size() != 2 || !pair[0].is_number() || !pair[1].is_number()) {
      return fail(ErrorCode::kParse, "`points`: expected pairs of x and y in metres");
    }
    const Vec2 point{pair[0].get<double>(), pair[1].get<double>()};
    const bool near = std::abs(point.x) <= kFarthest_m && std::abs(point.y) <= kFarthest_m;
    if (!near)
      return fail(ErrorCode::kParse, "`points`: expected coordinates within ±{} m", kFarthest_m);
    points.push_back(point);
  }
  return points;
}

Status read_place(JsonMembers& members, RunRequest& request) {
  const bool path = request.kind == Kind::kPath;
  RAVE_TRY_ASSIGN(request.points, points_of(members, path));
  if (!path && members.has("yaw")) {
    RAVE_TRY_ASSIGN(request.yaw_rad, number_within(members, "yaw", kMostYaw_rad));
  }
  if (request.kind == Kind::kPlace || !members.has("speed")) return {};
  RAVE_TRY_ASSIGN(request.speed_mps, members.number("speed"));
  if (request.speed_mps < 0 || request.speed_mps > kMostSpeed_mps) {
    return fail(ErrorCode::kParse, "`speed`: expected 0 to {} m/s", kMostSpeed_mps);
  }
  return {};
}

/// Reads the members that belong to the kind of request.
Status read_kind(JsonMembers& members, RunRequest& request) {
  switch (request.kind) {
    case Kind::kDrive: {
      RAVE_TRY_ASSIGN(request.v_mps, number_within(members, "v", kMostSpeed_mps));
      RAVE_TRY_ASSIGN(request.w_radps, number_within(members, "w", kMostTurn_radps));
      return {};
    }
    case Kind::kGoal:
    case Kind::kPath:
    case Kind::kPlace:
      return read_place(members, request);
    case Kind::kText: {
      RAVE_TRY_ASSIGN(request.value, members.text("text", kLongestText));
      if (request.value.empty()) return fail(ErrorCode::kParse, "`text`: expected text");
      return {};
    }
    case Kind::kTake: {
      if (!members.has("force")) return {};
      RAVE_TRY_ASSIGN(const bool force, members.flag("force"));
      request.value = force ? "force" : "";
      return {};
    }
    case Kind::kGive: {
      if (!members.has("to")) return {};
      RAVE_TRY_ASSIGN(request.value, members.text("to", kLongestName));
      return {};
    }
    default:
      return {};
  }
}

bool is_for_lines(Kind kind) {
  switch (kind) {
    case Kind::kDrive:
    case Kind::kGoal:
    case Kind::kPath:
    case Kind::kCancel:
    case Kind::kText:
    case Kind::kPlace:
    case Kind::kTake:
    case Kind::kGive:
    case Kind::kStop:
    case Kind::kRelease:
      return true;
    default:
      return false;
  }
}

/// Whether an order of this kind may address all robots.
bool takes_all(Kind kind) {
  return kind == Kind::kStop || kind == Kind::kRelease || kind == Kind::kCancel;
}

Result<LineMessage> order_of(JsonMembers& members) {
  OrderMessage order;
  RAVE_TRY_ASSIGN(order.id, members.whole("id"));
  RAVE_TRY_ASSIGN(const std::string word, members.text("kind", kLongestName));
  const auto kind = runtime::request_kind(word);
  if (!kind || !is_for_lines(*kind)) {
    return fail(ErrorCode::kParse,
                "`kind`: expected drive, goal, path, cancel, text, place, take, give, stop or "
                "release");
  }
  order.request.kind = *kind;
  if (members.has("robot")) {
    RAVE_TRY_ASSIGN(order.request.robot, members.text("robot", kLongestName));
  }
  if (order.request.robot.empty() && !takes_all(*kind)) {
    return fail(ErrorCode::kParse, "`robot`: expected a name");
  }
  RAVE_TRY(read_kind(members, order.request));
  if (members.has("echo")) {
    RAVE_TRY_ASSIGN(order.echo, members.flag("echo"));
  }
  return LineMessage(std::move(order));
}

Result<LineMessage> hello_of(JsonMembers& members) {
  HelloMessage hello;
  RAVE_TRY_ASSIGN(hello.ticket, members.text("ticket", kLongestTicket));
  RAVE_TRY_ASSIGN(const std::string proof, members.text("proof", kLongestProof));
  auto bytes = from_base64(proof);
  if (!bytes) return fail(ErrorCode::kParse, "`proof`: expected base64url");
  hello.proof = *std::move(bytes);
  return LineMessage(std::move(hello));
}

Result<LineMessage> message_of_type(const std::string& type, JsonMembers& members) {
  if (type == "hello") return hello_of(members);
  if (type == "order") return order_of(members);
  if (type == "ping") {
    PingMessage ping;
    RAVE_TRY_ASSIGN(ping.id, members.whole("id"));
    return LineMessage(ping);
  }
  if (type == "ticket") {
    RenewMessage renew;
    RAVE_TRY_ASSIGN(renew.ticket, members.text("ticket", kLongestTicket));
    return LineMessage(std::move(renew));
  }
  return fail(ErrorCode::kParse, "`type`: expected hello, order, ping or ticket");
}

}  // namespace

Result<LineMessage> parse_line_message(std::string_view text) {
  RAVE_TRY_ASSIGN(const nlohmann::json object, JsonMembers::parse_object(text, "message"));
  JsonMembers members(object);
  RAVE_TRY_ASSIGN(const std::string type, members.text("type", kLongestName));
  auto message = message_of_type(type, members);
  if (message) RAVE_TRY(members.finish());
  return message;
}

}  // namespace rave::direct_line
