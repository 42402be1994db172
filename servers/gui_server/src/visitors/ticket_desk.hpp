// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "people/audit_log.hpp"
#include "rave/direct_line/lines.hpp"
#include "rave/gui_server/person.hpp"
#include "rave/web/message.hpp"
#include "visitors/view.hpp"

namespace rave::gui_server {

/// Gives pages tickets for the direct lines of hosts, and takes them back when the rights of their
/// owner become others. The thread of the server.
class TicketDesk {
 public:
  explicit TicketDesk(std::shared_ptr<AuditLog> audit);

  /// The hosts of the run, and the key that they know. Before that pages get the answer that there
  /// are no lines.
  void offer(std::shared_ptr<direct_line::Lines> lines, const direct_line::SigningKey& key);

  /// Who asks, and what they get of the run.
  struct Asker {
    Person person;
    std::string session;  ///< The secret.
    std::shared_ptr<const View> view;
    bool relay = false;  ///< Whether orders may go through this server.
  };
  /// Answers `POST /ticket`.
  [[nodiscard]] web::Response serve(const web::Request& request, const Asker& asker);

  /// What a session may now; nothing: it is over.
  using Rights = std::function<std::optional<std::string>(const std::string& session)>;
  /// Withdraws the tickets of those whose rights are others than they were. Twice a second.
  void check(const Rights& rights);
  /// The same as Rights gives it.
  [[nodiscard]] static std::string rights_of(const Person& person, const View& view);

  /// Where the lines end, for the Content-Security-Policy of the page.
  [[nodiscard]] std::vector<std::string> ends() const;
  /// Lines of runs to come may end at any port of the machine of `origin`: a page that is open
  /// already cannot be given another policy.
  void expect_lines_at(std::string_view origin);

 private:
  struct Given {
    std::string user;
    std::string rights;
    std::int64_t until_s = 0;
  };
  void note(const Asker& asker, const direct_line::Ticket& ticket, const std::string& peer);
  [[nodiscard]] std::uint64_t epoch_of(const std::string& user) const;
  void raise(const std::string& user);

  std::shared_ptr<AuditLog> audit_;            ///< Shared with all who note something.
  std::shared_ptr<direct_line::Lines> lines_;  ///< Shared with the command line; may be null.
  std::vector<std::string> expected_;          ///< Always in ends().
  direct_line::SigningKey key_{};
  std::uint64_t first_epoch_;
  std::map<std::string, std::uint64_t, std::less<>> epochs_;  ///< By person, above the first one.
  std::map<std::string, Given> given_;                        ///< By session.
};

}  // namespace rave::gui_server
