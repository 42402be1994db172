// SPDX-License-Identifier: Apache-2.0
#include "foxglove/foxglove_door.hpp"

#include <algorithm>
#include <array>

#include "people/secrets.hpp"

namespace rave::gui_server {
namespace {

/// The same protocol by its two names; the later one came with the software development kit.
constexpr std::array<std::string_view, 2> kFoxgloveProtocols = {"foxglove.websocket.v1",
                                                                "foxglove.sdk.v1"};
constexpr std::size_t kTokenLetters = 48;

/// Whether a list such as `a, b` names a subprotocol.
bool names_protocol(std::string_view list, std::string_view wanted) {
  while (!list.empty()) {
    const std::size_t comma = list.find(',');
    std::string_view word = list.substr(0, comma);
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    if (word == wanted) return true;
    if (comma == std::string_view::npos) return false;
    list.remove_prefix(comma + 1);
  }
  return false;
}

}  // namespace

Status check_foxglove_origin(std::string_view origin) {
  if (origin == "file://") return {};
  const std::size_t mark = origin.find("://");
  const std::string_view scheme = origin.substr(0, std::min(mark, origin.size()));
  const std::string_view host = mark == std::string_view::npos ? "" : origin.substr(mark + 3);
  const bool plain = !host.empty() && std::ranges::all_of(host, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == ':' ||
           c == '[' || c == ']';
  });
  const bool known = !scheme.empty() && std::ranges::all_of(scheme, [](char c) {
    return (c >= 'a' && c <= 'z') || c == '-';
  });
  if (plain && known) return {};
  return fail(
      ErrorCode::kInvalidArgument,
      "`{}` is not an origin: expected scheme and host in lower case, without a path, such as "
      "https://app.foxglove.dev, or file://",
      origin);
}

FoxgloveDoor::FoxgloveDoor(Door& door, std::shared_ptr<AuditLog> audit,
                           std::vector<std::string> origins)
    : door_(door), audit_(std::move(audit)), origins_(std::move(origins)), key_(new_secret()) {}

std::string FoxgloveDoor::token_of(const std::string& session) {
  std::string token = hash_of(key_ + session).substr(0, kTokenLetters);
  sessions_[hash_of(token)] = session;
  return token;
}

std::string FoxgloveDoor::session_of(const web::Request& request) const {
  const auto token = request.query.find("token");
  if (token == request.query.end()) return {};
  const auto known = sessions_.find(hash_of(token->second));
  return known == sessions_.end() ? std::string() : known->second;
}

web::Handler::Upgrade FoxgloveDoor::upgrade(const web::Request& request) {
  const std::string_view origin = request.header("origin");
  if (!origin.empty() && std::ranges::find(origins_, origin) == origins_.end()) {
    audit_->note("refused", {{"why", "foxglove origin"}, {"from", request.peer}});
    return {
        web::text_response(403, "this origin is not listed; --foxglove-origin ORIGIN lists it\n"),
        {}};
  }
  const auto person = door_.whose(session_of(request));
  if (!person) {
    audit_->note("refused", {{"why", "foxglove token"}, {"from", request.peer}});
    return {web::text_response(401, "the token is missing, wrong or expired\n"), {}};
  }
  const std::string_view offered = request.header("sec-websocket-protocol");
  for (const std::string_view protocol : kFoxgloveProtocols) {
    if (!names_protocol(offered, protocol)) continue;
    audit_->note("login", {{"user", person->name}, {"by", "foxglove"}, {"from", request.peer}});
    return {std::nullopt, std::string(protocol)};
  }
  return {web::text_response(400, "expected the subprotocol foxglove.websocket.v1\n"), {}};
}

void FoxgloveDoor::check() {
  std::erase_if(sessions_, [this](const auto& entry) { return !door_.whose(entry.second); });
}

}  // namespace rave::gui_server
