// SPDX-License-Identifier: Apache-2.0
#include "request_fields.hpp"

#include <cmath>
#include <concepts>
#include <string>
#include <utility>

#include "rave/control/chat_line.hpp"
#include "rave/math/finite.hpp"
#include "rave/robot/order.hpp"

namespace rave::control {
namespace {

using runtime::RunRequest;
using Kind = RunRequest::Kind;

constexpr std::size_t kMaxWordBytes = 4096;
constexpr std::uint64_t kMaxSteps = 1'000'000'000;

/// Moves a member out of an object; false if it exists but has another type.
template <class T>
bool take(Json& json, const char* key, T& value) {
  const auto member = json.find(key);
  if (member == json.end()) return true;
  const bool fits = std::same_as<T, std::string>     ? member->is_string()
                    : std::same_as<T, bool>          ? member->is_boolean()
                    : std::same_as<T, std::uint64_t> ? member->is_number_unsigned()
                                                     : member->is_number();
  if (!fits) return false;
  value = member->template get<T>();
  json.erase(key);
  return true;
}

bool take_text(Json& json, const char* key, std::string& text) {
  return take(json, key, text) && text.size() <= kMaxWordBytes &&
         text.find('\0') == std::string::npos;
}

/// The author of a request; only requests that change something may name one.
bool take_author(Json& json, RunRequest& request) {
  const bool has_page = json.contains("page");
  return take_text(json, "by", request.by) && request.by.size() <= kMostOrderAuthor &&
         take(json, "overrides", request.overrides) && take(json, "page", request.page) &&
         (request.page > 0 || !has_page);
}

/// Reads a finite number; with `needed` it must exist.
bool take_number(Json& json, const char* key, bool needed, double& value) {
  if (!json.contains(key)) return !needed;
  return take(json, key, value) && std::isfinite(value);
}

bool take_yaw(Json& json, RunRequest& request) {
  if (!json.contains("yaw")) return true;
  return take_number(json, "yaw", true, request.yaw_rad.emplace());
}

/// A list of points, each a list of x and y.
bool take_points(Json& json, std::size_t least, std::size_t most, RunRequest& request) {
  if (!json.contains("points") || !json.at("points").is_array()) return false;
  const Json points = std::move(json.at("points"));
  json.erase("points");
  if (points.size() < least || points.size() > most) return false;
  for (const Json& point : points) {
    const bool is_point =
        point.is_array() && point.size() == 2 && point[0].is_number() && point[1].is_number();
    if (!is_point) return false;
    request.points.push_back({point[0].get<double>(), point[1].get<double>()});
    if (!is_finite(request.points.back())) return false;
  }
  return true;
}

bool take_robot(Json& json, RunRequest& request) {
  return take_text(json, "robot", request.robot) && !request.robot.empty();
}

/// The members of orders and leases.
bool take_order(Json& json, RunRequest& request) {
  if (!take_author(json, request)) return false;
  switch (request.kind) {
    case Kind::kDrive:
      return take_robot(json, request) && take_number(json, "v", true, request.v_mps) &&
             take_number(json, "w", true, request.w_radps);
    case Kind::kGoal:
      return take_robot(json, request) && take_points(json, 1, 1, request) &&
             take_yaw(json, request) && take_number(json, "speed", false, request.speed_mps);
    case Kind::kPath:
      return take_robot(json, request) && take_points(json, 2, kMostOrderPoints, request) &&
             take_number(json, "speed", false, request.speed_mps);
    case Kind::kPlace:
      return take_robot(json, request) && take_points(json, 1, 1, request) &&
             take_yaw(json, request);
    case Kind::kText:
      return take_robot(json, request) && take_text(json, "value", request.value) &&
             !request.value.empty() && request.value.size() <= kMostOrderText;
    case Kind::kCancel:
      return take_text(json, "robot", request.robot);
    case Kind::kChat:
      return take_text(json, "key", request.key) && take_text(json, "value", request.value) &&
             runtime::chat_line(request).has_value();
    default:
      return take_robot(json, request) && take_text(json, "value", request.value) &&
             request.value.size() <= kMostOrderAuthor;
  }
}

}  // namespace

bool take_request_fields(Json& json, Request& request) {
  RunRequest& run = request.run;
  if (request.what == Request::What::kRun && !take(json, "relay", request.relay)) return false;
  if (request.what == Request::What::kRun && run.kind >= Kind::kDrive) return take_order(json, run);
  if (!request.only_reads() && !take_author(json, run)) return false;
  if (request.what == Request::What::kStep) {
    return take(json, "count", request.count) && request.count >= 1 && request.count <= kMaxSteps;
  }
  if (request.what != Request::What::kRun) return true;
  switch (run.kind) {
    case Kind::kStop:
    case Kind::kRelease:
    case Kind::kArm:
    case Kind::kResetShadow:
      return take_text(json, "robot", run.robot);
    case Kind::kSet:
      return take_text(json, "robot", run.robot) && take_text(json, "key", run.key) &&
             take_text(json, "value", run.value) && !run.robot.empty() && !run.key.empty() &&
             !run.value.empty();
    case Kind::kHandOver:
      return take_text(json, "robot", run.robot) && take_text(json, "value", run.value) &&
             !run.robot.empty() && !run.value.empty();
    default:
      return true;
  }
}

}  // namespace rave::control
