// SPDX-License-Identifier: Apache-2.0
#include "rave/direct_line/ticket.hpp"

#include <algorithm>
#include <span>

#include "rave/base/hash.hpp"
#include "rave/base/json_text.hpp"
#include "rave/direct_line/json_members.hpp"
#include "signed_text.hpp"

namespace rave::direct_line {
namespace {

constexpr std::size_t kLongestWord = 256;
constexpr const char* kTicketWord = "ticket";
constexpr const char* kWithdrawalWord = "withdrawal";

Json json_of(const RobotSet& robots) {
  if (robots.all) return "*";
  return robots.names;
}

Result<RobotSet> robots_of(JsonMembers& members, const char* name) {
  RAVE_TRY_ASSIGN(const Json* const value, members.any(name));
  RobotSet robots;
  if (value->is_string() && value->get<std::string>() == "*") {
    robots.all = true;
    return robots;
  }
  if (!value->is_array()) return fail(ErrorCode::kParse, "`{}`: expected names or \"*\"", name);
  for (const Json& robot : *value) {
    if (!robot.is_string()) return fail(ErrorCode::kParse, "`{}`: expected names", name);
    robots.names.insert(robot.get<std::string>());
  }
  return robots;
}

Status check_version(JsonMembers& members) {
  RAVE_TRY_ASSIGN(const std::uint64_t version, members.whole("v"));
  if (version == 1) return {};
  return fail(ErrorCode::kParse, "unknown version {}: expected 1", version);
}

Result<Ticket> ticket_of(const Json& object) {
  JsonMembers members(object);
  RAVE_TRY(check_version(members));
  Ticket ticket;
  RAVE_TRY_ASSIGN(ticket.run, members.text("run", kLongestWord));
  RAVE_TRY_ASSIGN(ticket.host, members.text("host", kLongestWord));
  RAVE_TRY_ASSIGN(ticket.user, members.text("user", kLongestWord));
  RAVE_TRY_ASSIGN(ticket.role, members.choice("role", {"commander", "super_user"}));
  RAVE_TRY_ASSIGN(ticket.origin, members.text("origin", kLongestWord));
  RAVE_TRY_ASSIGN(ticket.orders, robots_of(members, "orders"));
  RAVE_TRY_ASSIGN(ticket.stops, robots_of(members, "stops"));
  RAVE_TRY_ASSIGN(ticket.releases, robots_of(members, "releases"));
  RAVE_TRY_ASSIGN(const std::string key, members.text("key", kLongestWord));
  RAVE_TRY_ASSIGN(ticket.page_key, page_key_of(key));
  RAVE_TRY_ASSIGN(ticket.epoch, members.whole("epoch"));
  RAVE_TRY_ASSIGN(const std::uint64_t expires_s, members.whole("expires"));
  ticket.expires_s = static_cast<std::int64_t>(expires_s);
  RAVE_TRY_ASSIGN(ticket.nonce, members.text("nonce", kLongestWord));
  RAVE_TRY(members.finish());
  // Leases and logs identify a person by the name; an empty one would stand for the terminal.
  if (ticket.user.empty()) return fail(ErrorCode::kParse, "`user`: expected a name");
  return ticket;
}

}  // namespace

Result<std::string> page_key_of(std::string_view text) {
  constexpr std::size_t kPointBytes = 65;
  auto key = from_base64(text);
  // 4: the point is not compressed.
  if (key && key->size() == kPointBytes && key->front() == 4) return *std::move(key);
  return fail(ErrorCode::kParse, "`key`: expected an uncompressed point of P-256 in base64url");
}

std::uint64_t page_number(std::string_view key) {
  // 0 stands for a lease without a page.
  return std::max<std::uint64_t>(1, content_hash(std::as_bytes(std::span(key))));
}

std::string sign_ticket(const Ticket& ticket, const SigningKey& key) {
  const Json object = {{"v", 1},
                       {"run", ticket.run},
                       {"host", ticket.host},
                       {"user", ticket.user},
                       {"role", ticket.role},
                       {"origin", ticket.origin},
                       {"orders", json_of(ticket.orders)},
                       {"stops", json_of(ticket.stops)},
                       {"releases", json_of(ticket.releases)},
                       {"key", base64_of(ticket.page_key)},
                       {"epoch", ticket.epoch},
                       {"expires", ticket.expires_s},
                       {"nonce", ticket.nonce}};
  return sign_text(kTicketWord, json_text(object), key);
}

Result<Ticket> verify_ticket(std::string_view text, const PublicKey& key, std::int64_t now_s) {
  RAVE_TRY_ASSIGN(const std::string content, verify_text(kTicketWord, text, key));
  RAVE_TRY_ASSIGN(const Json object, JsonMembers::parse_object(content, kTicketWord));
  RAVE_TRY_ASSIGN(Ticket ticket, ticket_of(object));
  if (ticket.expires_s + kClockSlack_s < now_s) {
    return fail(ErrorCode::kState, "the ticket has expired {} s ago", now_s - ticket.expires_s);
  }
  // The signer gives tickets for kTicketLife_s. One that lasts longer means that a clock is wrong,
  // and would outlive that promise.
  if (ticket.expires_s > now_s + kTicketLife_s + kClockSlack_s) {
    return fail(ErrorCode::kState,
                "the ticket is valid for {} s, longer than permitted: the clocks of this host and "
                "the GUI Server differ",
                ticket.expires_s - now_s);
  }
  return ticket;
}

std::string sign_withdrawal(const Withdrawal& withdrawal, const SigningKey& key) {
  const Json object = {
      {"v", 1}, {"run", withdrawal.run}, {"user", withdrawal.user}, {"epoch", withdrawal.epoch}};
  return sign_text(kWithdrawalWord, json_text(object), key);
}

Result<Withdrawal> verify_withdrawal(std::string_view text, const PublicKey& key) {
  RAVE_TRY_ASSIGN(const std::string content, verify_text(kWithdrawalWord, text, key));
  RAVE_TRY_ASSIGN(const Json object, JsonMembers::parse_object(content, kWithdrawalWord));
  JsonMembers members(object);
  RAVE_TRY(check_version(members));
  Withdrawal withdrawal;
  RAVE_TRY_ASSIGN(withdrawal.run, members.text("run", kLongestWord));
  RAVE_TRY_ASSIGN(withdrawal.user, members.text("user", kLongestWord));
  RAVE_TRY_ASSIGN(withdrawal.epoch, members.whole("epoch"));
  RAVE_TRY(members.finish());
  return withdrawal;
}

}  // namespace rave::direct_line
