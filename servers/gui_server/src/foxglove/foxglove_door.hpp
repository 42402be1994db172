// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "people/audit_log.hpp"
#include "people/door.hpp"
#include "rave/base/result.hpp"
#include "rave/web/server.hpp"

namespace rave::gui_server {

/// Whether a text is an origin as browsers send it (`https://app.foxglove.dev`, `file://`). Error
/// kInvalidArgument.
[[nodiscard]] Status check_foxglove_origin(std::string_view origin);

/// Who may connect with Foxglove: a token in the URL stands for a session of the door, and is good
/// as long as that is. Cookies do not count here, since pages of other origins are let in. The
/// thread of the server.
class FoxgloveDoor {
 public:
  /// `door` outlives it. `origins`: pages that may connect, beside programs that send no origin.
  FoxgloveDoor(Door& door, std::shared_ptr<AuditLog> audit, std::vector<std::string> origins);

  /// The token of a session that the door knows; the same one each time.
  [[nodiscard]] std::string token_of(const std::string& session);
  /// Answers 400 (subprotocol), 401 (token) or 403 (origin), or lets it through.
  [[nodiscard]] web::Handler::Upgrade upgrade(const web::Request& request);
  /// The session of the token in a request; empty: none.
  [[nodiscard]] std::string session_of(const web::Request& request) const;
  /// Forgets tokens whose sessions have ended.
  void check();

 private:
  Door& door_;
  std::shared_ptr<AuditLog> audit_;
  std::vector<std::string> origins_;
  std::string key_;                              ///< Secret, of this process.
  std::map<std::string, std::string> sessions_;  ///< By hash of the token.
};

}  // namespace rave::gui_server
