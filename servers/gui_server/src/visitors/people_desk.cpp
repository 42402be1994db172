// SPDX-License-Identifier: Apache-2.0
#include "visitors/people_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "rave/base/json_text.hpp"

namespace rave::gui_server {
namespace {

using DeskJson = nlohmann::ordered_json;

constexpr const char* kNoAccounts =
    "This server has no accounts: only the link printed in its terminal gives access, and there is "
    "no audit log. To let others in, start the server with --accounts DIR, and over a network also "
    "with --listen, --certificate and --key.";

std::string role_and_teams(Role role, const Teams& teams) {
  return fmt::format("{}, teams {}", to_string(role), teams.text());
}

PeopleDesk::Outcome refused(const PeopleMessage& message, std::string why) {
  PeopleDesk::Outcome outcome;
  outcome.answer = {std::string(word_of(message)), false, std::move(why), request_of(message), {}};
  return outcome;
}

PeopleDesk::Outcome done(const PeopleMessage& message, std::string text) {
  PeopleDesk::Outcome outcome = refused(message, std::move(text));
  outcome.answer.good = outcome.changed = true;
  return outcome;
}

Result<std::string> do_account(Accounts& accounts, const AccountMessage& asked) {
  using Do = AccountMessage::Do;
  if (asked.what == Do::kChange) {
    // For the audit log: it cannot be found out later.
    std::string before;
    for (const Account& account : accounts.state().accounts) {
      if (account.person.name != asked.name) continue;
      before = role_and_teams(account.person.role, account.person.teams);
    }
    RAVE_TRY(accounts.change_person({asked.name, asked.role, asked.teams}));
    return fmt::format("{}: {} (was {})", asked.name, role_and_teams(asked.role, asked.teams),
                       before);
  }
  if (asked.what == Do::kEndSessions) {
    RAVE_TRY_ASSIGN(const std::size_t count, accounts.end_sessions(asked.name));
    return fmt::format("{}: {} session{} ended", asked.name, count, count == 1 ? "" : "s");
  }
  const bool disabled = asked.what == Do::kDisable;
  RAVE_TRY(accounts.set_disabled(asked.name, disabled));
  return fmt::format("{}: {}", asked.name, disabled ? "disabled" : "enabled");
}

PeopleDesk::Outcome outcome_of(const PeopleDesk::Options& at, const AccountMessage& asked,
                               const std::string& by) {
  const auto text = do_account(*at.accounts, asked);
  if (!text) return refused(asked, text.error().message);
  // Noted only after the file was written: the log never claims a change that did not happen.
  at.audit->note("account", {{"user", by}, {"detail", *text}});
  return done(asked, *text);
}

/// The secret goes to the page that asked, and to no other page, once.
PeopleDesk::Outcome outcome_of(const PeopleDesk::Options& at, const InvitationMessage& asked,
                               const std::string& by) {
  if (!asked.make) {
    const auto withdrawn = at.accounts->withdraw(asked.id);
    if (!withdrawn) return refused(asked, withdrawn.error().message);
    const std::string text = fmt::format(
        "withdrawn: {}, of {}", role_and_teams(withdrawn->role, withdrawn->teams), withdrawn->by);
    at.audit->note("invitation", {{"user", by}, {"detail", text}});
    return done(asked, text);
  }
  const auto secret = at.accounts->invite(asked.role, asked.teams, static_cast<int>(asked.uses),
                                          static_cast<int>(asked.days), by, asked.name);
  if (!secret) return refused(asked, secret.error().message);
  const std::string text =
      fmt::format("made: {}, {} uses, {} days{}", role_and_teams(asked.role, asked.teams),
                  asked.uses, asked.days, asked.name.empty() ? "" : ", for " + asked.name);
  at.audit->note("invitation", {{"user", by}, {"detail", text}});
  PeopleDesk::Outcome outcome = done(asked, text);
  outcome.message = json_text(DeskJson{
      {"type", "invited"}, {"request", asked.request}, {"link", "/join?invite=" + *secret}});
  return outcome;
}

PeopleDesk::Outcome outcome_of(const PeopleDesk::Options& at, const AuditMessage& asked,
                               const std::string& /*by*/) {
  const AuditPage page = at.audit->read(asked.filter);
  DeskJson message = {{"type", "audit_lines"},
                      {"request", asked.request},
                      {"more", page.more},
                      {"lines", DeskJson::array()}};
  for (const AuditLine& line : page.lines) {
    DeskJson entry;
    for (const auto& [name, part] : kAuditFields) {
      if (!(line.*part).empty()) entry[name] = line.*part;
    }
    message["lines"].push_back(std::move(entry));
  }
  PeopleDesk::Outcome outcome = done(asked, fmt::format("{} lines", page.lines.size()));
  // Reading the log changes nothing, so the pages of other super-users need no news.
  outcome.changed = false;
  outcome.message = json_text(message);
  return outcome;
}

/// A person who did this to themselves would need another one to take it back.
bool locks_out(const AccountMessage& asked, const std::string& by) {
  using Do = AccountMessage::Do;
  if (asked.name != by) return false;
  return asked.what == Do::kDisable ||
         (asked.what == Do::kChange && asked.role != Role::kSuperUser);
}

}  // namespace

void PeopleDesk::take(const PeopleMessage& message, const std::string& by, const Tell& tell) {
  if (!options_.accounts) return tell(refused(message, kNoAccounts));
  const auto* const account = std::get_if<AccountMessage>(&message);
  if (account != nullptr && locks_out(*account, by)) {
    return tell(refused(message, "You cannot remove your own role of super-user."));
  }
  // Files and password hashes are slow, so another thread does the work, and the one of the server
  // gets the outcome.
  const bool posted = options_.work([at = options_, message, by, tell] {
    const auto act = [&](const auto& asked) { return outcome_of(at, asked, by); };
    at.post([tell, outcome = std::visit(act, message)] { tell(outcome); });
  });
  if (!posted) tell(refused(message, "The server is busy. Try again in a moment."));
}

std::string PeopleDesk::message(const std::map<std::string, unsigned>& pages,
                                unsigned links) const {
  DeskJson message = {{"type", "accounts"},
                      {"kept", options_.accounts != nullptr},
                      {"why_not", ""},
                      {"links", links},
                      {"people", DeskJson::array()},
                      {"invitations", DeskJson::array()}};
  if (!options_.accounts) {
    message["why_not"] = kNoAccounts;
    return json_text(message);
  }
  const AccountsFile state = options_.accounts->state();
  std::map<std::string_view, unsigned> sessions;
  for (const SessionEntry& session : state.sessions) ++sessions[session.user];
  for (const Account& account : state.accounts) {
    const auto open = pages.find(account.person.name);
    message["people"].push_back({{"name", account.person.name},
                                 {"role", to_string(account.person.role)},
                                 {"teams", account.person.teams.text()},
                                 {"guest", account.password.empty()},
                                 {"name_given", account.person.name_given},
                                 {"disabled", account.disabled},
                                 {"pages", open == pages.end() ? 0 : open->second},
                                 {"sessions", sessions[account.person.name]},
                                 {"seen_s", account.seen_s}});
  }
  for (const Invitation& invitation : state.invitations) {
    message["invitations"].push_back({{"id", invitation.id()},
                                      {"role", to_string(invitation.role)},
                                      {"teams", invitation.teams.text()},
                                      {"uses", invitation.uses},
                                      {"until_s", invitation.until_s},
                                      {"by", invitation.by},
                                      {"name", invitation.name}});
  }
  return json_text(message);
}

std::uint64_t PeopleDesk::revision() const {
  return options_.accounts ? options_.accounts->revision() : 0;
}

void PeopleDesk::note_gone(const std::string& name) {
  if (!options_.accounts) return;
  // If too many wait, the sign-in stays as the moment.
  static_cast<void>(options_.work(
      [accounts = options_.accounts, name] { static_cast<void>(accounts->note_seen(name)); }));
}

void PeopleDesk::give_name(const std::string& name) {
  if (!options_.accounts) return;
  const AccountsFile state = options_.accounts->state();
  // Only to who has it at this moment: who takes the name later was not meant.
  const bool chosen = std::ranges::any_of(state.accounts, [&name](const Account& account) {
    return account.person.name == name && !account.person.name_given;
  });
  if (!chosen) return;
  const bool posted = options_.work([accounts = options_.accounts, audit = options_.audit, name] {
    const Status given = accounts->give_name(name);
    if (!given) audit->note("accounts", {{"why", given.error().text()}});
  });
  if (!posted) options_.audit->note("accounts", {{"why", "too busy to give a name"}});
}

}  // namespace rave::gui_server
