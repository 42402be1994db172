// SPDX-License-Identifier: Apache-2.0
// What super-users ask about people, and the answers.
#include <algorithm>

#include "rave/config/people_file.hpp"
#include "rave/sim/event.hpp"
#include "visitors/visitors.hpp"

namespace rave::gui_server {

void Visitors::note_malformed(std::uint64_t id, std::string_view why, bool cut) {
  const auto found = visitors_.find(id);
  if (found == visitors_.end()) return;
  const std::string& user = found->second.person.name;
  audit_->note("refused", {{"why", "message"}, {"user", user}, {"detail", why}});
  if (cut) audit_->note("cut_off", {{"why", "malformed messages"}, {"user", user}});
}

void Visitors::flooded(std::uint64_t id) {
  const auto found = visitors_.find(id);
  if (found == visitors_.end()) return;
  audit_->note("cut_off", {{"why", "too many messages"}, {"user", found->second.person.name}});
}

bool Visitors::is_operator(const Visitor& visitor) {
  return known(visitor.person).name != visitor.person.name;
}

void Visitors::take_people(std::uint64_t id, const PeopleMessage& message) {
  Visitor& visitor = visitors_.at(id);
  if (!visitor.conducts()) {
    audit_->note("refused",
                 {{"why", "account"}, {"user", visitor.person.name}, {"detail", word_of(message)}});
    visitor.page->send(payload(answer_text({std::string(word_of(message)),
                                            false,
                                            "Only a super-user can do this.",
                                            request_of(message),
                                            {}})));
    return;
  }
  const std::string by = is_operator(visitor) ? std::string("operator") : visitor.person.name;
  people_desk_.take(
      message, by, [this, id](const PeopleDesk::Outcome& outcome) { told_of_people(id, outcome); });
}

void Visitors::told_of_people(std::uint64_t id, const PeopleDesk::Outcome& outcome) {
  // It takes effect before it is sent.
  if (outcome.changed) check();
  const auto found = visitors_.find(id);
  if (found == visitors_.end()) return;
  const Visitor& visitor = found->second;
  // Who lost the role meanwhile gets no link.
  if (!outcome.message.empty() && visitor.conducts()) {
    visitor.page->send(payload(outcome.message));
  }
  visitor.page->send(payload(answer_text(outcome.answer)));
}

void Visitors::note_arrivals() {
  std::set<std::string, std::less<>> names;
  for (const Person& person : people()) {
    if (!known_names_.contains(person.name)) room_.arrived(person.name);
    names.insert(person.name);
  }
  known_names_ = std::move(names);
}

void Visitors::tell_accounts() {
  if (!source_) return;
  const std::uint64_t lines = audit_->written() + 1;
  web::Payload accounts;
  for (auto& [id, visitor] : visitors_) {
    if (!visitor.conducts()) continue;
    if (visitor.told_accounts != accounts_news_) {
      if (!accounts) {
        std::map<std::string, unsigned> pages;
        unsigned links = 0;
        for (const auto& [other, there] : visitors_) {
          ++(is_operator(there) ? links : pages[there.person.name]);
        }
        accounts = payload(people_desk_.message(pages, links));
      }
      visitor.page->send(accounts);
      visitor.told_accounts = accounts_news_;
    }
    if (visitor.told_audit == lines) continue;
    visitor.told_audit = lines;
    if (audit_->keeps()) {
      visitor.page->send(
          payload(fmt::format(R"({{"type":"audit_written","lines":{}}})", lines - 1)));
    }
  }
}

void Visitors::give_teams() {
  if (!source_ || !source_->about().live || gifts_seen_ == source_->events_revision()) return;
  const std::span<const LogEvent> events = source_->events();
  const std::size_t first = gifts_seen_ == 0 ? 0 : source_->events_changed_since(gifts_seen_);
  gifts_seen_ = source_->events_revision();
  for (const LogEvent& event : events.subspan(std::min(first, events.size()))) {
    if (event.kind != to_string(sim::EventKind::kTeamGiven)) continue;
    // Behind the kind, as in the log of pages.
    const std::string_view text = std::string_view(event.text).substr(event.kind.size());
    if (!text.starts_with(": ")) continue;
    const auto gift = config::TeamGift::parse(text.substr(2));
    if (!gift) continue;
    const Status given = accounts_ ? accounts_->give_team(gift->first, gift->second)
                                   : fail(ErrorCode::kState, "the server has no accounts");
    audit_->note("team",
                 {{"user", gift->second}, {"detail", given ? gift->first : given.error().text()}});
  }
}

}  // namespace rave::gui_server
