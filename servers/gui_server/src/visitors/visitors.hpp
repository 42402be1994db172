// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "page/session.hpp"
#include "people/audit_log.hpp"
#include "people/door.hpp"
#include "visitors/chat_room.hpp"
#include "visitors/people_desk.hpp"
#include "visitors/restricted_source.hpp"
#include "visitors/rights_desk.hpp"

namespace rave::gui_server {

/// All pages that are connected, each with what its user gets of the run. The thread of the server.
class Visitors {
 public:
  /// `door` outlives it. `accounts`: null without any; shared with the door. `post`: calls
  /// something on the thread of the server.
  Visitors(Door& door, RightsDesk desk, std::shared_ptr<Accounts> accounts,
           std::shared_ptr<AuditLog> audit, PeopleDesk::Post post);

  /// Whether pages learn that Foxglove clients may connect; before the first page.
  void offer_foxglove(bool offered) noexcept { foxglove_ = offered; }
  /// All see this run from now on.
  void show(std::shared_ptr<Source> source);
  /// Who starts and ends runs for pages; without one they cannot.
  void conduct_by(std::shared_ptr<Conductor> conductor);
  /// A page came whose session the door knows.
  void opened(std::uint64_t id, web::Socket& socket, const std::string& session);
  void received(std::uint64_t id, std::string_view text);
  /// It sends too much, and is being closed for it.
  void flooded(std::uint64_t id);
  void closed(std::uint64_t id);
  /// Serves all pages; see Source::tick(). `audience`: what others than pages look at, in robots of
  /// the run.
  void tick(Audience audience = {});
  /// Twice a second: who was removed or signed out elsewhere is out, who got another role has its
  /// rights, and super-users know of it.
  void check();

  /// What a user gets, as for the recording; null: there is no run.
  [[nodiscard]] std::shared_ptr<const View> view_of(const Person& person);
  /// Whether a person may stop some robot, there or to come.
  [[nodiscard]] bool may_stop(const Person& person) const {
    return desk_.rights().of(person, InfoClass::kStop).kind != Reach::Kind::kNone;
  }
  /// The run as a view has it; one for all who have that view.
  [[nodiscard]] std::shared_ptr<Source> source_for(const std::shared_ptr<const View>& view);
  [[nodiscard]] const std::shared_ptr<Source>& source() const noexcept { return source_; }
  /// The name of a person for the run and other people.
  [[nodiscard]] static Person known(const Person& person);
  /// Whether a page of this session looks as another user.
  [[nodiscard]] bool sees_as_other(std::string_view session) const;
  [[nodiscard]] std::size_t count() const noexcept { return visitors_.size(); }

 private:
  struct Visitor {
    web::Socket* socket = nullptr;
    std::string session;  ///< The secret; to ask whether it still holds.
    Person person;
    std::optional<Person> eyes;  ///< With whose eyes a super-user looks.
    std::shared_ptr<const View> view;
    std::unique_ptr<Session> page;
    std::uint64_t number = 0;  ///< Of the page, as the run knows it.
    std::uint64_t told_chat = 0;
    std::uint64_t told_accounts = 0;  ///< Revision; 0: nothing yet.
    std::uint64_t told_audit = 0;     ///< Lines, and one.
    std::uint64_t told_conduct = 0;   ///< Revision; 0: nothing yet.

    [[nodiscard]] bool conducts() const {
      return person.role == Role::kSuperUser && !eyes.has_value();
    }
  };
  [[nodiscard]] static Author author_of(const Visitor& visitor);
  void show_to(Visitor& visitor, bool same_run);
  void show_again_if_other();
  void tell_rights();
  /// Does what the scenario of a live run says of who commands which team.
  void give_teams();
  [[nodiscard]] SessionCalls calls_of(std::uint64_t id);
  [[nodiscard]] Result<std::string> set_right(std::uint64_t id, const RightChange& change);
  [[nodiscard]] Result<std::string> see_as(std::uint64_t id, const SeeAsMessage& see);
  [[nodiscard]] Result<std::string> chat(std::uint64_t id, const ChatMessage& chat);
  void take_conduct(std::uint64_t id, const ConductMessage& message);
  void tell_conduct();
  /// Whether the person, or the one with whose eyes they look, may start and end runs here.
  [[nodiscard]] bool conducts_runs(const Visitor& visitor) const;
  void take_people(std::uint64_t id, const PeopleMessage& message);
  void told_of_people(std::uint64_t id, const PeopleDesk::Outcome& outcome);
  void tell_accounts();
  [[nodiscard]] static bool is_operator(const Visitor& visitor);
  void note_command(std::uint64_t id, const CommandMessage& command, const PageAnswer& answer);
  void note_malformed(std::uint64_t id, std::string_view why, bool cut);
  /// Whether a lease may be given to the person that is named.
  [[nodiscard]] Status may_give(std::uint64_t id, const CommandMessage& give) const;
  [[nodiscard]] bool is_there(const std::string& name) const;
  void tell_chat();
  void tell_people();
  [[nodiscard]] std::vector<Person> people() const;
  /// Who has come to the accounts since the last call is new to the chat.
  void note_arrivals();

  Door& door_;
  RightsDesk desk_;
  std::shared_ptr<Accounts> accounts_;
  std::shared_ptr<AuditLog> audit_;
  bool foxglove_ = false;
  std::shared_ptr<Source> source_;        ///< Null: none yet.
  std::shared_ptr<Conductor> conductor_;  ///< Null: runs are started elsewhere. Shared with it.
  std::map<const View*, std::weak_ptr<RestrictedSource>> restricted_;
  SharedTexts texts_;
  std::map<std::uint64_t, Visitor> visitors_;
  ChatRoom room_;
  PeopleDesk people_desk_;
  std::uint64_t accounts_revision_ = 0;             ///< Of the file.
  std::uint64_t accounts_news_ = 1;                 ///< Of the file and of who is there.
  std::set<std::string, std::less<>> known_names_;  ///< Of the accounts.
  std::uint64_t gifts_seen_ = 0;                    ///< Revision of the events of the run.
  std::string told_people_;
  std::string trouble_;  ///< With the accounts; told once.
};

}  // namespace rave::gui_server
