// SPDX-License-Identifier: Apache-2.0
#include "line_message.hpp"

#include <utility>

#include "rave/direct_line/order_members.hpp"
#include "rave/direct_line/ticket.hpp"
#include "signed_text.hpp"

namespace rave::direct_line {
namespace {

using runtime::RunRequest;
using Kind = RunRequest::Kind;

constexpr std::size_t kLongestName = 256;
constexpr std::size_t kLongestProof = 128;

constexpr WordTable<Kind, 10> kOrders = {{{"drive", Kind::kDrive},
                                          {"goal", Kind::kGoal},
                                          {"path", Kind::kPath},
                                          {"cancel", Kind::kCancel},
                                          {"text", Kind::kText},
                                          {"place", Kind::kPlace},
                                          {"take", Kind::kTake},
                                          {"give", Kind::kGive},
                                          {"stop", Kind::kStop},
                                          {"release", Kind::kRelease}}};

/// Reads what an order about the lease of a robot has.
Status read_lease(JsonMembers& members, RunRequest& request) {
  if (request.kind == Kind::kTake && members.has("force")) {
    RAVE_TRY_ASSIGN(const bool force, members.flag("force"));
    request.value = force ? "force" : "";
  }
  if (request.kind == Kind::kGive && members.has("to")) {
    RAVE_TRY_ASSIGN(request.value, members.text("to", kLongestName));
  }
  return {};
}

/// Whether an order of this kind may address all robots.
bool takes_all(Kind kind) {
  return kind == Kind::kStop || kind == Kind::kRelease || kind == Kind::kCancel;
}

Result<LineMessage> order_of(JsonMembers& members) {
  OrderMessage order;
  RAVE_TRY_ASSIGN(order.id, members.whole("id"));
  RAVE_TRY_ASSIGN(order.request.kind, members.choice("kind", kOrders));
  if (members.has("robot")) {
    RAVE_TRY_ASSIGN(order.request.robot, members.text("robot", kLongestName));
  }
  if (order.request.robot.empty() && !takes_all(order.request.kind)) {
    return fail(ErrorCode::kParse, "`robot`: expected a name");
  }
  RAVE_TRY(read_order(members, 1, order.request));
  RAVE_TRY(read_lease(members, order.request));
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
