// SPDX-License-Identifier: Apache-2.0
#include "line_message.hpp"

#include <utility>

#include "rave/direct_line/order_members.hpp"
#include "rave/direct_line/ticket.hpp"
#include "signed_text.hpp"

namespace rave::direct_line {
namespace {

constexpr std::size_t kLongestName = 256;
constexpr std::size_t kLongestProof = 128;

Result<request::Action> action_of(JsonMembers& members) {
  using namespace request;
  RAVE_TRY_ASSIGN(const std::string_view word,
                  members.choice("kind", {Drive::kName, Goal::kName, Path::kName, Cancel::kName,
                                          Text::kName, Place::kName, Take::kName, Give::kName,
                                          Stop::kName, Release::kName}));
  if (const auto kind = order_named(word)) {
    RAVE_TRY_ASSIGN(ReadOrder read, read_order(members, *kind, 1));
    return request::action_of(std::move(read.order));
  }
  if (word == Take::kName) {
    Take take;
    if (members.has("force")) {
      RAVE_TRY_ASSIGN(take.force, members.flag("force"));
    }
    return take;
  }
  if (word == Give::kName) {
    Give give;
    if (members.has("to")) {
      RAVE_TRY_ASSIGN(give.to, members.text("to", kLongestName));
    }
    return give;
  }
  if (word == Stop::kName) return Stop();
  return Release();
}

Result<LineMessage> order_of(JsonMembers& members) {
  OrderMessage order;
  RAVE_TRY_ASSIGN(order.id, members.whole("id"));
  RAVE_TRY_ASSIGN(order.request.action, action_of(members));
  if (members.has("robot")) {
    RAVE_TRY_ASSIGN(order.request.robot, members.text("robot", kLongestName));
  }
  if (order.request.robot.empty() && request::needs_robot(order.request.action)) {
    return fail(ErrorCode::kParse, "`robot`: expected a name");
  }
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

Result<LineMessage> ping_of(JsonMembers& members) {
  PingMessage ping;
  RAVE_TRY_ASSIGN(ping.id, members.whole("id"));
  return LineMessage(ping);
}

Result<LineMessage> renew_of(JsonMembers& members) {
  RenewMessage renew;
  RAVE_TRY_ASSIGN(renew.ticket, members.text("ticket", kLongestTicket));
  return LineMessage(std::move(renew));
}

using Take = Result<LineMessage> (*)(JsonMembers&);
constexpr WordTable<Take, 4> kTypes = {
    {{"hello", hello_of}, {"order", order_of}, {"ping", ping_of}, {"ticket", renew_of}}};

}  // namespace

Result<LineMessage> parse_line_message(std::string_view text) {
  RAVE_TRY_ASSIGN(const Json object, JsonMembers::parse_object(text, "message"));
  JsonMembers members(object);
  RAVE_TRY_ASSIGN(const Take take, members.choice("type", kTypes));
  auto message = take(members);
  if (message) RAVE_TRY(members.finish());
  return message;
}

}  // namespace rave::direct_line
