// SPDX-License-Identifier: Apache-2.0
#include "request_fields.hpp"

#include <cmath>
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

/// Moves a text out of an object; false if the member exists but is not a valid text.
bool take_text(Json& json, const char* key, std::string& text) {
  if (!json.contains(key)) return true;
  const Json& value = json.at(key);
  if (!value.is_string()) return false;
  text = value.get<std::string>();
  json.erase(key);
  return text.size() <= kMaxWordBytes && text.find('\0') == std::string::npos;
}

bool take_count(Json& json, std::uint64_t& count) {
  if (!json.contains("count")) return true;
  const Json& value = json.at("count");
  if (!value.is_number_unsigned()) return false;
  count = value.get<std::uint64_t>();
  json.erase("count");
  return count >= 1 && count <= kMaxSteps;
}

bool take_flag(Json& json, const char* key, bool& value) {
  if (!json.contains(key)) return true;
  if (!json.at(key).is_boolean()) return false;
  value = json.at(key).get<bool>();
  json.erase(key);
  return true;
}

bool take_page(Json& json, std::uint64_t& page) {
  if (!json.contains("page")) return true;
  if (!json.at("page").is_number_unsigned()) return false;
  page = json.at("page").get<std::uint64_t>();
  json.erase("page");
  return page > 0;
}

/// The author of a request; only requests that change something may name one.
bool take_author(Json& json, RunRequest& request) {
  return take_text(json, "by", request.by) && request.by.size() <= kMostOrderAuthor &&
         take_flag(json, "overrides", request.overrides) && take_page(json, request.page);
}

/// Reads a finite number; with `needed` it must exist.
bool take_number(Json& json, const char* key, bool needed, double& value) {
  if (!json.contains(key)) return !needed;
  if (!json.at(key).is_number()) return false;
  value = json.at(key).get<double>();
  json.erase(key);
  return std::isfinite(value);
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
  if (request.what == Request::What::kRun && run.kind >= Kind::kDrive) return take_order(json, run);
  if (!request.only_reads() && !take_author(json, run)) return false;
  if (request.what == Request::What::kStep) return take_count(json, request.count);
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
