// SPDX-License-Identifier: Apache-2.0
#include "rave/control/protocol.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "rave/base/names.hpp"
#include "rave/control/chat_line.hpp"
#include "rave/control/order_words.hpp"
#include "rave/robot/order.hpp"

namespace rave::control {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxWordBytes = 4096;
constexpr std::uint64_t kMaxSteps = 1'000'000'000;

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

/// An object without repeated keys; discarded for anything else.
Json parse_object(std::string_view line) {
  std::vector<std::set<std::string>> keys;
  bool repeated = false;
  const auto watch = [&](int /*depth*/, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key) {
      repeated |= !keys.back().insert(parsed.get<std::string>()).second;
    }
    return true;
  };
  Json json = Json::parse(line, watch, false);
  if (repeated || !json.is_object()) return Json(Json::value_t::discarded);
  return json;
}

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

std::optional<Request::What> take_what(Json& json) {
  std::string word;
  if (!take_text(json, "do", word)) return std::nullopt;
  for (const Word& known : kWords) {
    if (known.name == word) return known.what;
  }
  return std::nullopt;
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
bool take_author(Json& json, Request& request) {
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

bool take_yaw(Json& json, Request& request) {
  if (!json.contains("yaw")) return true;
  return take_number(json, "yaw", true, request.yaw_rad.emplace());
}

/// A list of points, each a list of x and y.
bool take_points(Json& json, std::size_t least, std::size_t most, Request& request) {
  if (!json.contains("points") || !json.at("points").is_array()) return false;
  const Json points = std::move(json.at("points"));
  json.erase("points");
  if (points.size() < least || points.size() > most) return false;
  for (const Json& point : points) {
    const bool is_point =
        point.is_array() && point.size() == 2 && point[0].is_number() && point[1].is_number();
    if (!is_point) return false;
    request.points.push_back({point[0].get<double>(), point[1].get<double>()});
    const Vec2 last = request.points.back();
    if (!std::isfinite(last.x) || !std::isfinite(last.y)) return false;
  }
  return true;
}

/// Checks the number of points before the points are read, to give a specific error message.
Status check_points(Request::What what, const Json& json) {
  if (what != Request::What::kPath || !json.contains("points")) return {};
  const Json& points = json.at("points");
  return points.is_array() ? runtime::check_path_size(points.size()) : Status();
}

bool take_robot(Json& json, Request& request) {
  return take_text(json, "robot", request.robot) && !request.robot.empty();
}

/// The members of orders and leases.
bool take_order(Json& json, Request& request) {
  if (!take_author(json, request)) return false;
  switch (request.what) {
    case Request::What::kDrive:
      return take_robot(json, request) && take_number(json, "v", true, request.v_mps) &&
             take_number(json, "w", true, request.w_radps);
    case Request::What::kGoal:
      return take_robot(json, request) && take_points(json, 1, 1, request) &&
             take_yaw(json, request) && take_number(json, "speed", false, request.speed_mps);
    case Request::What::kPath:
      return take_robot(json, request) && take_points(json, 2, kMostOrderPoints, request) &&
             take_number(json, "speed", false, request.speed_mps);
    case Request::What::kPlace:
      return take_robot(json, request) && take_points(json, 1, 1, request) &&
             take_yaw(json, request);
    case Request::What::kText:
      return take_robot(json, request) && take_text(json, "value", request.value) &&
             !request.value.empty() && request.value.size() <= kMostOrderText;
    case Request::What::kCancel:
      return take_text(json, "robot", request.robot);
    case Request::What::kChat:
      return take_text(json, "key", request.key) && take_text(json, "value", request.value) &&
             runtime::chat_line(run_request(request)).has_value();
    default:
      return take_robot(json, request) && take_text(json, "value", request.value) &&
             request.value.size() <= kMostOrderAuthor;
  }
}

/// The members of each kind of request; false if one of them is invalid.
bool take_details(Json& json, Request& request) {
  if (request.what >= Request::What::kDrive) return take_order(json, request);
  const bool changes =
      request.what != Request::What::kStatus && request.what != Request::What::kList;
  if (changes && !take_author(json, request)) return false;
  switch (request.what) {
    case Request::What::kStop:
    case Request::What::kRelease:
    case Request::What::kArm:
    case Request::What::kResetShadow:
      return take_text(json, "robot", request.robot);
    case Request::What::kSet:
      return take_text(json, "robot", request.robot) && take_text(json, "key", request.key) &&
             take_text(json, "value", request.value) && !request.robot.empty() &&
             !request.key.empty() && !request.value.empty();
    case Request::What::kHandOver:
      return take_text(json, "robot", request.robot) && take_text(json, "value", request.value) &&
             !request.robot.empty() && !request.value.empty();
    case Request::What::kStep:
      return take_count(json, request.count);
    case Request::What::kAdd:
    case Request::What::kMove:
      return take_text(json, "value", request.value) && !request.value.empty();
    case Request::What::kRemove:
      return take_text(json, "key", request.key) && !request.key.empty();
    default:
      return true;
  }
}

Json hand_over_json(const runtime::RunStatus::HandOver& hand_over) {
  return {
      {"under_way", hand_over.under_way}, {"made", hand_over.made}, {"refused", hand_over.refused},
      {"last", hand_over.last},           {"x_m", hand_over.x_m},   {"y_m", hand_over.y_m},
      {"yaw_rad", hand_over.yaw_rad}};
}

Json shadow_json(const runtime::RunStatus::Shadow& shadow) {
  Json json = {
      {"running", shadow.running}, {"since_s", shadow.since_s}, {"m", shadow.m},
      {"rad", shadow.rad},         {"most_m", shadow.most_m},   {"most_rad", shadow.most_rad},
      {"readings", Json::array()}};
  for (const auto& reading : shadow.readings) {
    json["readings"].push_back({{"sensor", reading.sensor},
                                {"unit", reading.unit},
                                {"last", reading.last},
                                {"most", reading.most}});
  }
  return json;
}

Json lateness_json(const runtime::RunStatus::Lateness& late) {
  return {{"deadlines", late.deadlines},
          {"missed", late.missed},
          {"worst_s", late.worst_s},
          {"behind_s", late.behind_s},
          {"phase", late.phase}};
}

Json status_json(const runtime::RunStatus& status) {
  Json json = {
      {"scenario", status.scenario}, {"sim_s", status.sim_s}, {"duration_s", status.duration_s},
      {"pace", status.pace},         {"live", status.live},   {"paused", status.paused},
      {"robots", Json::array()}};
  if (status.lateness) json["lateness"] = lateness_json(*status.lateness);
  if (!status.waits_for.empty()) json["waits_for"] = status.waits_for;
  for (const runtime::RunStatus::Robot& robot : status.robots) {
    json["robots"].push_back({{"name", robot.name},
                              {"simulated", robot.simulated},
                              {"armed", robot.armed},
                              {"stopped", robot.stopped}});
    Json& last = json["robots"].back();
    if (robot.hand_over) last["hand_over"] = hand_over_json(*robot.hand_over);
    if (robot.shadow) last["shadow"] = shadow_json(*robot.shadow);
    if (!robot.lease.empty()) last["lease"] = robot.lease;
    if (robot.lease_page != 0) last["lease_page"] = robot.lease_page;
    if (!robot.takes.empty()) last["takes"] = robot.takes;
    if (!robot.order.empty()) last["order"] = robot.order;
  }
  return json;
}

bool read_bool(const Json& json, const char* key, bool& value) {
  if (!json.contains(key) || !json.at(key).is_boolean()) return false;
  value = json.at(key).get<bool>();
  return true;
}

bool read_number(const Json& json, const char* key, double& value) {
  if (!json.contains(key) || !json.at(key).is_number()) return false;
  value = json.at(key).get<double>();
  return true;
}

bool read_text(const Json& json, const char* key, std::string& value) {
  if (!json.contains(key) || !json.at(key).is_string()) return false;
  value = json.at(key).get<std::string>();
  return true;
}

bool read_count(const Json& json, const char* key, std::uint32_t& value) {
  if (!json.contains(key) || !json.at(key).is_number_unsigned()) return false;
  const auto whole = json.at(key).get<std::uint64_t>();
  value = static_cast<std::uint32_t>(whole);
  return whole <= UINT32_MAX;
}

bool read_count(const Json& json, const char* key, std::uint64_t& value) {
  if (!json.contains(key) || !json.at(key).is_number_unsigned()) return false;
  value = json.at(key).get<std::uint64_t>();
  return true;
}

bool read_lateness(const Json& json, runtime::RunStatus::Lateness& late) {
  return json.is_object() && read_count(json, "deadlines", late.deadlines) &&
         read_count(json, "missed", late.missed) && read_number(json, "worst_s", late.worst_s) &&
         read_number(json, "behind_s", late.behind_s) && read_text(json, "phase", late.phase);
}

bool read_hand_over(const Json& json, runtime::RunStatus::HandOver& hand_over) {
  return json.is_object() && read_bool(json, "under_way", hand_over.under_way) &&
         read_count(json, "made", hand_over.made) &&
         read_count(json, "refused", hand_over.refused) &&
         read_text(json, "last", hand_over.last) && read_number(json, "x_m", hand_over.x_m) &&
         read_number(json, "y_m", hand_over.y_m) && read_number(json, "yaw_rad", hand_over.yaw_rad);
}

bool read_shadow(const Json& json, runtime::RunStatus::Shadow& shadow) {
  bool good = json.is_object() && read_bool(json, "running", shadow.running) &&
              read_number(json, "since_s", shadow.since_s) && read_number(json, "m", shadow.m) &&
              read_number(json, "rad", shadow.rad) && read_number(json, "most_m", shadow.most_m) &&
              read_number(json, "most_rad", shadow.most_rad) && json.contains("readings") &&
              json.at("readings").is_array();
  if (!good) return false;
  for (const Json& item : json.at("readings")) {
    runtime::RunStatus::Shadow::Reading reading;
    good = good && item.is_object() && read_text(item, "sensor", reading.sensor) &&
           read_text(item, "unit", reading.unit) && read_number(item, "last", reading.last) &&
           read_number(item, "most", reading.most);
    shadow.readings.push_back(std::move(reading));
  }
  return good;
}

/// Which orders a robot accepts and executes; older processes do not report that.
bool read_orders(const Json& item, runtime::RunStatus::Robot& robot) {
  if (item.contains("lease") && !read_text(item, "lease", robot.lease)) return false;
  if (item.contains("lease_page") && !read_count(item, "lease_page", robot.lease_page))
    return false;
  if (item.contains("order") && !read_text(item, "order", robot.order)) return false;
  if (!item.contains("takes")) return true;
  if (!item.at("takes").is_array()) return false;
  for (const Json& word : item.at("takes")) {
    if (!word.is_string()) return false;
    robot.takes.push_back(word.get<std::string>());
  }
  return true;
}

bool read_status(const Json& json, runtime::RunStatus& status) {
  bool good = json.is_object() && read_text(json, "scenario", status.scenario) &&
              read_number(json, "sim_s", status.sim_s) &&
              read_number(json, "duration_s", status.duration_s) &&
              read_number(json, "pace", status.pace) && read_bool(json, "live", status.live) &&
              read_bool(json, "paused", status.paused) && json.contains("robots") &&
              json.at("robots").is_array();
  if (good && json.contains("waits_for")) good = read_text(json, "waits_for", status.waits_for);
  if (!good) return false;
  if (json.contains("lateness")) {
    good = read_lateness(json.at("lateness"), *(status.lateness = runtime::RunStatus::Lateness{}));
  }
  for (const Json& item : json.at("robots")) {
    runtime::RunStatus::Robot robot;
    good = good && item.is_object() && read_text(item, "name", robot.name) &&
           read_bool(item, "simulated", robot.simulated) && read_bool(item, "armed", robot.armed) &&
           read_bool(item, "stopped", robot.stopped);
    if (good && item.contains("hand_over")) {
      good =
          read_hand_over(item.at("hand_over"), *(robot.hand_over = runtime::RunStatus::HandOver{}));
    }
    if (good && item.contains("shadow")) {
      good = read_shadow(item.at("shadow"), *(robot.shadow = runtime::RunStatus::Shadow{}));
    }
    good = good && read_orders(item, robot);
    status.robots.push_back(std::move(robot));
  }
  return good;
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
  Json json = parse_object(line);
  if (json.is_discarded()) {
    return fail(ErrorCode::kParse, "expected a JSON object without duplicate keys");
  }
  if (!json.contains("rave") || json.at("rave") != 1) {
    return fail(ErrorCode::kParse, "expected `\"rave\": 1`, the version of this protocol");
  }
  json.erase("rave");
  Request request;
  const auto what = take_what(json);
  if (!what || json.contains("do")) {
    std::vector<std::string_view> names;
    for (const Word& word : kWords) names.push_back(word.name);
    return fail(ErrorCode::kInvalidArgument, "expected `do` to be one of {}", join_names(names));
  }
  request.what = *what;
  RAVE_TRY(check_points(*what, json));
  if (!take_details(json, request)) {
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
  const Json json = parse_object(line);
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
