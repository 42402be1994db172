// SPDX-License-Identifier: Apache-2.0
#include "rave/control/protocol.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "answer_json.hpp"
#include "line_json.hpp"
#include "rave/base/names.hpp"
#include "rave/codec/nodes.hpp"
#include "rave/codec/variant_codec.hpp"
#include "rave/robot/order.hpp"

namespace rave::control {

template <class V>
void describe(V&, AskStatus&) {}
template <class V>
void describe(V&, Pause&) {}
template <class V>
void describe(V&, Resume&) {}
template <class V>
void describe(V& v, Step& c) {
  v.field("count", c.count, {.doc = "Number of steps.", .min = 1, .max = 1e9});
}
template <class V>
void describe(V& v, Pace& c) {
  v.field("factor", c.factor,
          {.doc = "Simulated seconds per second; 0: no limit.", .min = 0, .max = 1e6});
}
template <class V>
void describe(V&, End&) {}

namespace {

using codec::RawNode;
using Own = codec::Codec<ProcessAction>;

constexpr std::string_view kVersion = "rave";
constexpr std::int64_t kNumber = 2;
constexpr std::string_view kRelay = "relay";

bool is_named(const RawNode& name, std::span<const std::string_view> names) {
  const auto text = name.as_text();
  return text && std::ranges::find(names, *text) != names.end();
}

/// Checks the version, and that `do` is known.
Status check_form(const RawNode& node) {
  const RawNode* const version = node.is_mapping() ? node.find(kVersion) : nullptr;
  if (version == nullptr || version->as_int() != kNumber) {
    return fail(ErrorCode::kParse,
                "expected an object with `\"rave\": 2`, the version of this protocol");
  }
  const RawNode* const name = node.find(codec::kVariantKey);
  const auto of_run = request::action_names();
  if (name != nullptr && (is_named(*name, Own::kNames) || is_named(*name, of_run))) return {};
  std::vector<std::string_view> words(Own::kNames.begin(), Own::kNames.end());
  words.insert(words.end(), of_run.begin(), of_run.end());
  return fail(ErrorCode::kInvalidArgument, "expected `do` to be one of {}", join_names(words));
}

Result<Request> own_request(RawNode node) {
  Request request;
  RAVE_TRY_ASSIGN(request.run, request::take_sender(node));
  RAVE_TRY_ASSIGN(request.own, codec::read_node<ProcessAction>(node));
  const bool has_sender = !(request.run == request::Request{});
  if (!request.run.robot.empty() || (request.only_reads() && has_sender)) {
    return fail(ErrorCode::kInvalidArgument, "unexpected key: `{}` has no robot{}",
                codec::name_of(*request.own), request.only_reads() ? " and no author" : "");
  }
  return request;
}

}  // namespace

std::string too_long_text() {
  return fmt::format("the line is longer than {} bytes, which hold a path of {} points",
                     kMaxLineBytes, kMostOrderPoints);
}

Result<Request> parse_request(std::string_view line) {
  if (line.size() > kMaxLineBytes) return fail(ErrorCode::kParse, "{}", too_long_text());
  RAVE_TRY_ASSIGN(RawNode node, codec::parse_json(line));
  RAVE_TRY(check_form(node));
  node.erase(kVersion);
  bool relay = false;
  if (const RawNode* const found = node.find(kRelay)) {
    RAVE_TRY_ASSIGN(relay, codec::read_node<bool>(*found));
    node.erase(kRelay);
  }
  if (is_named(*node.find(codec::kVariantKey), Own::kNames)) {
    RAVE_TRY_ASSIGN(Request own, own_request(std::move(node)));
    own.relay = relay;
    return own;
  }
  Request request{std::nullopt, {}, relay};
  RAVE_TRY_ASSIGN(request.run, request::from_node(node));
  return request;
}

std::string write_request(const Request& request) {
  RawNode line = RawNode::mapping({{kVersion, RawNode::integer(kNumber)}});
  RawNode rest;
  if (request.own) {
    rest = codec::write_node(*request.own);
    request::append_sender(request.run, rest);
  } else {
    rest = request::to_node(request.run);
  }
  for (std::size_t i = 0; i < rest.size(); ++i) line.append(rest.key(i), std::move(rest.child(i)));
  if (request.relay) line.append(std::string(kRelay), codec::write_node(true));
  return codec::to_json_line(line) + "\n";
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
