// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "page/page_text.hpp"
#include "page/people_message.hpp"
#include "people/audit_log.hpp"
#include "rave/gui_server/accounts.hpp"

namespace rave::gui_server {

/// What super-users ask about accounts, invitations and the audit log, and what they receive about
/// them. The caller has checked that a super-user asks. The thread of the server; the
/// disk is waited for on another one.
class PeopleDesk {
 public:
  /// Does something on another thread; false: too many wait.
  using Work = std::function<bool(std::function<void()>)>;
  /// Does something on the thread of the server, soon. Any thread.
  using Post = std::function<void(std::function<void()>)>;
  struct Options {
    std::shared_ptr<Accounts> accounts;  ///< Null: there are none. Shared with the door.
    std::shared_ptr<AuditLog> audit;     ///< Shared with all who note something.
    Work work;
    Post post;
  };
  /// What came of a request: an answer, and before it a message for this page alone.
  struct Outcome {
    PageAnswer answer;
    std::string message;   ///< Empty: none.
    bool changed = false;  ///< Accounts or invitations are others.
  };
  using Tell = std::function<void(const Outcome&)>;

  explicit PeopleDesk(Options options) : options_(std::move(options)) {}

  /// Does what is asked and notes it. `by`: the account that asks. `tell` is called on the thread
  /// of the server, now or later, or never if the server ends before.
  void take(const PeopleMessage& message, const std::string& by, const Tell& tell);
  /// The message `accounts`. `pages`: how many each person has open, by name of the account.
  /// `links`: how many are open by links of the terminal.
  [[nodiscard]] std::string message(const std::map<std::string, unsigned>& pages,
                                    unsigned links) const;
  /// Another number whenever that message may be another one for the same pages.
  [[nodiscard]] std::uint64_t revision() const;
  /// The last page of a person was closed.
  void note_gone(const std::string& name);
  /// A super-user gave this person a right of their own, and with that the name that they chose.
  void give_name(const std::string& name);

 private:
  Options options_;
};

}  // namespace rave::gui_server
