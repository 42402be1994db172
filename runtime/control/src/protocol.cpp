// SPDX-License-Identifier: Apache-2.0
#include "rave/control/protocol.hpp"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "line_json.hpp"
#include "rave/base/names.hpp"
#include "rave/control/order_words.hpp"
#include "rave/robot/order.hpp"
#include "request_fields.hpp"
#include "status_json.hpp"

namespace rave::control {
namespace {

struct Word {
  std::string_view name;
  Request::What what;
};
constexpr std::array kWords = {Word{"status", Request::What::kStatus},
                               Word{"stop", Request::What::kStop},
                               Word{"release", Request::What::kRelease},
                               Word{"arm", Request::What::kArm},
                               Word{"set", Request::What::kSet},
                               Word{"pause", Request::What::kPause},
                               Word{"resume", Request::What::kResume},
                               Word{"step", Request::What::kStep},
                               Word{"end", Request::What::kEnd},
                               Word{"add", Request::What::kAdd},
                               Word{"move", Request::What::kMove},
                               Word{"remove", Request::What::kRemove},
                               Word{"list", Request::What::kList},
                               Word{"hand_over", Request::What::kHandOver},
                               Word{"reset_shadow", Request::What::kResetShadow},
                               Word{"drive", Request::What::kDrive},
                               Word{"goal", Request::What::kGoal},
                               Word{"path", Request::What::kPath},
                               Word{"cancel", Request::What::kCancel},
                               Word{"text", Request::What::kText},
                               Word{"place", Request::What::kPlace},
                               Word{"take", Request::What::kTake},
                               Word{"give", Request::What::kGive},
                               Word{"chat", Request::What::kChat}};

using RunKind = runtime::RunRequest::Kind;

struct RunWord {
  Request::What what;
  RunKind kind;
};
/// The requests to a run, in both forms.
constexpr std::array kRunWords = {RunWord{Request::What::kStop, RunKind::kStop},
                                  RunWord{Request::What::kRelease, RunKind::kRelease},
                                  RunWord{Request::What::kArm, RunKind::kArm},
                                  RunWord{Request::What::kSet, RunKind::kSet},
                                  RunWord{Request::What::kAdd, RunKind::kAdd},
                                  RunWord{Request::What::kMove, RunKind::kMove},
                                  RunWord{Request::What::kRemove, RunKind::kRemove},
                                  RunWord{Request::What::kList, RunKind::kList},
                                  RunWord{Request::What::kHandOver, RunKind::kHandOver},
                                  RunWord{Request::What::kResetShadow, RunKind::kResetShadow},
                                  RunWord{Request::What::kDrive, RunKind::kDrive},
                                  RunWord{Request::What::kGoal, RunKind::kGoal},
                                  RunWord{Request::What::kPath, RunKind::kPath},
                                  RunWord{Request::What::kCancel, RunKind::kCancel},
                                  RunWord{Request::What::kText, RunKind::kText},
                                  RunWord{Request::What::kPlace, RunKind::kPlace},
                                  RunWord{Request::What::kTake, RunKind::kTake},
                                  RunWord{Request::What::kGive, RunKind::kGive},
                                  RunWord{Request::What::kChat, RunKind::kChat}};

std::optional<Request::What> take_what(Json& json) {
  if (!json.contains("do") || !json.at("do").is_string()) return std::nullopt;
  const auto word = json.at("do").get<std::string>();
  json.erase("do");
  for (const Word& known : kWords) {
    if (known.name == word) return known.what;
  }
  return std::nullopt;
}

/// Checks the number of points before the points are read, to give a specific error message.
Status check_points(Request::What what, const Json& json) {
  if (what != Request::What::kPath || !json.contains("points")) return {};
  const Json& points = json.at("points");
  return points.is_array() ? runtime::check_path_size(points.size()) : Status();
}

}  // namespace

Request request_of(const runtime::RunRequest& request) {
  Request asked;
  for (const auto& [what, kind] : kRunWords) {
    if (kind == request.kind) asked.what = what;
  }
  asked.robot = request.robot;
  asked.key = request.key;
  asked.value = request.value;
  asked.by = request.by;
  asked.overrides = request.overrides;
  asked.page = request.page;
  asked.points = request.points;
  asked.yaw_rad = request.yaw_rad;
  asked.v_mps = request.v_mps;
  asked.w_radps = request.w_radps;
  asked.speed_mps = request.speed_mps;
  return asked;
}

runtime::RunRequest run_request(const Request& request) {
  runtime::RunRequest asked;
  for (const auto& [what, kind] : kRunWords) {
    if (what == request.what) asked.kind = kind;
  }
  asked.robot = request.robot;
  asked.key = request.key;
  asked.value = request.value;
  asked.by = request.by;
  asked.overrides = request.overrides;
  asked.page = request.page;
  asked.points = request.points;
  asked.yaw_rad = request.yaw_rad;
  asked.v_mps = request.v_mps;
  asked.w_radps = request.w_radps;
  asked.speed_mps = request.speed_mps;
  return asked;
}

std::string too_long_text() {
  return fmt::format("the line is longer than {} bytes, which hold a path of {} points",
                     kMaxLineBytes, kMostOrderPoints);
}

Result<Request> parse_request(std::string_view line) {
  if (line.size() > kMaxLineBytes) return fail(ErrorCode::kParse, "{}", too_long_text());
  Json json = parse_line_object(line);
  if (json.is_discarded()) {
    return fail(ErrorCode::kParse, "expected a JSON object without duplicate keys");
  }
  if (!json.contains("rave") || json.at("rave") != 1) {
    return fail(ErrorCode::kParse, "expected `\"rave\": 1`, the version of this protocol");
  }
  json.erase("rave");
  Request request;
  const auto what = take_what(json);
  if (!what) {
    std::vector<std::string_view> names;
    for (const Word& word : kWords) names.push_back(word.name);
    return fail(ErrorCode::kInvalidArgument, "expected `do` to be one of {}", join_names(names));
  }
  request.what = *what;
  RAVE_TRY(check_points(*what, json));
  if (!take_request_fields(json, request)) {
    return fail(ErrorCode::kInvalidArgument, "a key is missing or has the wrong type");
  }
  if (!json.empty()) {
    return fail(ErrorCode::kInvalidArgument, "unexpected key `{}`", json.begin().key());
  }
  return request;
}

std::string write_request(const Request& request) {
  Json json = {{"rave", 1}};
  for (const Word& word : kWords) {
    if (word.what == request.what) json["do"] = word.name;
  }
  if (!request.robot.empty()) json["robot"] = request.robot;
  if (!request.key.empty()) json["key"] = request.key;
  if (!request.value.empty()) json["value"] = request.value;
  if (request.what == Request::What::kStep) json["count"] = request.count;
  if (!request.by.empty()) json["by"] = request.by;
  if (request.overrides) json["overrides"] = true;
  if (request.page != 0) json["page"] = request.page;
  for (const Vec2 p_W : request.points) json["points"].push_back({p_W.x, p_W.y});
  if (request.yaw_rad) json["yaw"] = *request.yaw_rad;
  if (request.speed_mps != 0) json["speed"] = request.speed_mps;
  if (request.what == Request::What::kDrive) {
    json["v"] = request.v_mps;
    json["w"] = request.w_radps;
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<Answer> parse_answer(std::string_view line) {
  const Json json = parse_line_object(line);
  Answer answer;
  if (json.is_discarded() || !read_bool(json, "good", answer.good) ||
      !read_text(json, "text", answer.text) ||
      (json.contains("status") && !read_status(json.at("status"), answer.status))) {
    return fail(ErrorCode::kParse, "the answer of the run is malformed");
  }
  return answer;
}

std::string write_answer(const Answer& answer) {
  Json json = {{"good", answer.good}, {"text", answer.text}};
  if (!answer.status.scenario.empty()) json["status"] = status_json(answer.status);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rave::control
