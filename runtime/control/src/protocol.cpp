// SPDX-License-Identifier: Apache-2.0
#include "rave/control/protocol.hpp"

#include <fmt/format.h>

#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "answer_json.hpp"
#include "line_json.hpp"
#include "rave/base/names.hpp"
#include "rave/base/word_table.hpp"
#include "rave/control/order_words.hpp"
#include "rave/robot/order.hpp"
#include "request_fields.hpp"

namespace rave::control {
namespace {

using What = Request::What;
using Kind = runtime::RunRequest::Kind;

/// Requests that do not go to the run; those that do have the words of their kinds.
constexpr WordTable<What, 5> kWords = {{{"status", What::kStatus},
                                        {"pause", What::kPause},
                                        {"resume", What::kResume},
                                        {"step", What::kStep},
                                        {"end", What::kEnd}}};

std::string_view word_of(const Request& request) noexcept {
  const std::string_view word = kWords.of(request.what);
  return word.empty() ? runtime::to_string(request.run.kind) : word;
}

std::string all_words() {
  const auto own = kWords.words();
  std::vector<std::string_view> words(own.begin(), own.end());
  for (auto kind = 0; kind <= static_cast<int>(Kind::kChat); ++kind) {
    words.push_back(runtime::to_string(static_cast<Kind>(kind)));
  }
  return join_names(words);
}

/// The request that `do` names, without its details.
std::optional<Request> take_what(Json& json) {
  if (!json.contains("do") || !json.at("do").is_string()) return std::nullopt;
  const auto asked = json.at("do").get<std::string>();
  json.erase("do");
  if (const auto what = kWords.find(asked)) return Request{*what};
  const auto kind = runtime::request_kind(asked);
  return kind ? std::optional(request_of({*kind, ""})) : std::nullopt;
}

/// Checks the number of points before the points are read, to give a specific error message.
Status check_points(const runtime::RunRequest& run, const Json& json) {
  if (run.kind != Kind::kPath || !json.contains("points")) return {};
  const Json& points = json.at("points");
  return points.is_array() ? runtime::check_path_size(points.size()) : Status();
}

/// An edit is described where files are, which also says what is wrong with it.
Status take_edit(Json& json, runtime::RunRequest& run) {
  if (run.kind != Kind::kEdit) return {};
  if (!json.contains("edit")) {
    return fail(ErrorCode::kInvalidArgument,
                "`edit` is missing: expected an object with one of `add_obstacle`, "
                "`move_obstacle` and `remove_obstacle`");
  }
  auto edit = config::read_edit(json.at("edit").dump(), "edit");
  // Lines have no places that would help the user.
  if (!edit) return fail(edit.error().code, "{}", edit.error().message);
  run.edit = *std::move(edit);
  json.erase("edit");
  return {};
}

}  // namespace

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
  auto request = take_what(json);
  if (!request) {
    return fail(ErrorCode::kInvalidArgument, "expected `do` to be one of {}", all_words());
  }
  RAVE_TRY(check_points(request->run, json));
  RAVE_TRY(take_edit(json, request->run));
  if (!take_request_fields(json, *request)) {
    return fail(ErrorCode::kInvalidArgument, "a key is missing or has the wrong type");
  }
  if (!json.empty()) {
    return fail(ErrorCode::kInvalidArgument, "unexpected key `{}`", json.begin().key());
  }
  return *std::move(request);
}

std::string write_request(const Request& request) {
  const runtime::RunRequest& run = request.run;
  Json json = {{"rave", 1}, {"do", word_of(request)}};
  if (!run.robot.empty()) json["robot"] = run.robot;
  if (!run.key.empty()) json["key"] = run.key;
  if (!run.value.empty()) json["value"] = run.value;
  if (request.what == What::kStep) json["count"] = request.count;
  if (!run.by.empty()) json["by"] = run.by;
  if (run.overrides) json["overrides"] = true;
  if (run.page != 0) json["page"] = run.page;
  if (request.relay) json["relay"] = true;
  for (const Vec2 p_W : run.points) json["points"].push_back({p_W.x, p_W.y});
  if (run.edit) json["edit"] = Json::parse(config::write_edit(*run.edit));
  if (run.yaw_rad) json["yaw"] = *run.yaw_rad;
  if (run.speed_mps != 0) json["speed"] = run.speed_mps;
  if (request.what == What::kRun && run.kind == Kind::kDrive) {
    json["v"] = run.v_mps;
    json["w"] = run.w_radps;
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<Answer> parse_answer(std::string_view line) {
  const Json json = parse_line_object(line);
  Answer answer;
  if (!read_answer(json, answer)) {
    return fail(ErrorCode::kParse, "the answer of the run is malformed");
  }
  return answer;
}

std::string write_answer(const Answer& answer) {
  return answer_json(answer).dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rave::control
