// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "people/audit_log.hpp"
#include "people/entrance.hpp"
#include "people/slow_work.hpp"
#include "rave/gui_server/accounts.hpp"
#include "rave/gui_server/person.hpp"
#include "rave/web/rate_limit.hpp"
#include "rave/web/server.hpp"

namespace rave::gui_server {

/// Who comes in, and how: one-time links, sign-in, invitations, sign-out. The thread of the server,
/// but for new_key(). Passwords are checked on a thread of its own.
class Door {
 public:
  struct Options {
    std::shared_ptr<Accounts> accounts;  ///< Null: links alone. Shared with the command line.
    std::shared_ptr<AuditLog> audit;     ///< Shared with all who note something.
    bool tls = false;
  };
  explicit Door(Options options);

  /// Cookies are named after the port: browsers keep them by host alone.
  void set_port(std::uint16_t port);
  /// For a link that lets a super-user in, once. Any thread.
  [[nodiscard]] std::string new_key() { return entrance_.new_key(); }

  /// The secret of a session of a super-user, which was not opened by a link. Any thread.
  [[nodiscard]] std::string new_session();

  /// Whether a request is one of those with which people sign in. They must be able to, whatever
  /// others at their address do; what is slow about it has limits of its own.
  [[nodiscard]] static bool is_door(const web::Request& request);
  /// Answers what is about coming in and going; nothing: another handler answers it.
  [[nodiscard]] std::optional<web::Response> serve(const web::Request& request);
  /// The same of what takes time. False: it takes none.
  [[nodiscard]] bool serve_later(const web::Request& request, const web::Reply& reply);
  /// Nothing: not signed in.
  [[nodiscard]] std::optional<Person> who(const web::Request& request) const;
  /// The secret of a session, to ask again who it is. Empty: there is none.
  [[nodiscard]] std::string session_of(const web::Request& request) const;
  [[nodiscard]] std::optional<Person> whose(std::string_view session) const;
  /// The names that rights mention: no invited person can choose one of them.
  void keep_names(NameSet names) { kept_names_ = std::move(names); }
  /// Takes in what others have written to the accounts; once a second. Error: see Accounts.
  [[nodiscard]] Status refresh();
  /// Does something that waits for a disk, where passwords are checked. False: too many wait.
  [[nodiscard]] bool later(std::function<void()> call) { return work_.post(std::move(call)); }
  /// Before the server ends: no reply comes any more.
  void stop() { work_.stop(); }

 private:
  [[nodiscard]] web::Response enter(const web::Request& request);
  [[nodiscard]] web::Response leave(const web::Request& request);
  [[nodiscard]] web::Response welcome(const std::string& session) const;
  [[nodiscard]] web::Response slow_down(const web::Request& request);
  using Fields = std::map<std::string, std::string>;  ///< Of a form, by name.
  void sign_in(const web::Request& request, const Fields& fields, const web::Reply& reply);
  void join(const web::Request& request, const Fields& fields, const web::Reply& reply);
  void work(const web::Request& request, std::function<web::Response()> what,
            const web::Reply& reply);

  Options options_;
  Entrance entrance_;
  std::string cookie_;
  NameSet kept_names_;
  web::RateLimit by_place_;  ///< Of a name from one network.
  web::RateLimit by_name_;
  SlowWork work_;  ///< The last: what it does uses the others.
};

}  // namespace rave::gui_server
