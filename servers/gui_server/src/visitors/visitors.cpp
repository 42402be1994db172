// SPDX-License-Identifier: Apache-2.0
#include "visitors/visitors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "people/secrets.hpp"
#include "rave/control/obstacle_edits.hpp"
#include "rave/direct_line/ticket.hpp"

namespace rave::gui_server {
namespace {

constexpr std::uint16_t kSignedOut = 4401;
constexpr const char* kSuperUsersOnly = "Only a super-user can do this.";

std::string right_text(const RightChange& change) {
  std::string reach = "usual";
  if (change.reach && change.reach->kind == Reach::Kind::kTeams) {
    reach = Teams{false, change.reach->teams}.text();
  } else if (change.reach) {
    reach = kReaches.of(change.reach->kind);
  }
  return fmt::format("{} of {}: {}", to_string(change.what),
                     change.role ? to_string(*change.role) : std::string_view(change.user), reach);
}

/// Who has the link of the server is "you" to themselves alone.
constexpr const char* kOperator = "the operator";

Person known_as(const Person& person) {
  Person known = person;
  if (known.name == "you" && known.role == Role::kSuperUser) known.name = kOperator;
  return known;
}

std::string command_text(const CommandMessage& command, const PageAnswer& answer) {
  const auto* const edit = command.as<request::Edit>();
  std::string text = edit != nullptr
                         ? fmt::format("{} {}", runtime::word_of(edit->edit), *edit->edit.name())
                         : fmt::format("{}, {} robots", command.name(), command.slots.size());
  return answer.good ? text : fmt::format("{}: {}", text, answer.text);
}

std::string halt_text(const HaltMessage& halt, bool good) {
  const std::string robots =
      halt.slots.empty() ? "all robots" : fmt::format("{} robots", halt.slots.size());
  return fmt::format("{}{}", robots, good ? "" : ", failed");
}

}  // namespace

Visitors::Visitors(Door& door, RightsDesk desk, std::shared_ptr<Accounts> accounts,
                   std::shared_ptr<AuditLog> audit, PeopleDesk::Post post)
    : door_(door),
      desk_(std::move(desk)),
      accounts_(std::move(accounts)),
      audit_(std::move(audit)),
      people_desk_({accounts_, audit_,
                    [&door](std::function<void()> call) { return door.later(std::move(call)); },
                    std::move(post)}) {
  door_.keep_names(desk_.mentioned());
}

void Visitors::show(std::shared_ptr<Source> source) {
  source_ = std::move(source);
  restricted_.clear();
  gifts_seen_ = 0;
  const RunAbout& about = source_->about();
  desk_.begin(
      about.name, about.rights,
      std::make_shared<const Cast>(cast_of(source_->robots_json(), source_->bodies_json())));
  door_.keep_names(desk_.mentioned());
  if (!about.live) room_.begin(source_->chat(), desk_.cast());
  for (auto& [id, visitor] : visitors_) {
    visitor.view = desk_.view_of(visitor.eyes.value_or(visitor.person));
    show_to(visitor, false);
  }
  tell_rights();
}

void Visitors::opened(std::uint64_t id, web::Socket& socket, const std::string& session) {
  Visitor visitor;
  visitor.socket = &socket;
  visitor.session = session;
  visitor.number = direct_line::page_number(new_secret());
  // A session may end between the request and now. Then the page is an observer of no team, until
  // check() closes it.
  visitor.person = door_.whose(session).value_or(Person{"", Role::kObserver, {false, {}}});
  visitor.page = std::make_unique<Session>(socket, calls_of(id));
  Visitor& kept = visitors_.emplace(id, std::move(visitor)).first->second;
  if (!source_) return;
  if (const Status read = source_->refresh_components(); !read) {
    audit_->note("components", {{"why", read.error().text()}});
  }
  note_arrivals();
  kept.view = desk_.view_of(kept.person);
  show_to(kept, false);
  if (kept.person.role == Role::kSuperUser) {
    kept.page->send(std::make_shared<const std::string>(desk_.message(people())));
  }
  ++accounts_news_;
  tell_accounts();
  tell_conduct();
}

void Visitors::closed(std::uint64_t id) {
  const auto found = visitors_.find(id);
  if (found == visitors_.end()) return;
  Visitor gone = std::move(found->second);
  visitors_.erase(found);
  // What it drives stands, and is left.
  gone.page.reset();
  told_people_.clear();
  ++accounts_news_;
  const bool more = std::any_of(visitors_.begin(), visitors_.end(), [&gone](const auto& entry) {
    return entry.second.person.name == gone.person.name;
  });
  if (!more && !is_operator(gone)) people_desk_.note_gone(gone.person.name);
}

void Visitors::received(std::uint64_t id, std::string_view text) {
  if (const auto found = visitors_.find(id); found != visitors_.end()) {
    found->second.page->received(text);
  }
}

std::shared_ptr<Source> Visitors::source_for(const std::shared_ptr<const View>& view) {
  if (view->whole()) return source_;
  // Pages of equal rights share one, so that each moment is cut and encoded once. Weak: it goes
  // with the last of its pages.
  auto& shared = restricted_[view.get()];
  if (auto known = shared.lock()) return known;
  auto restricted = std::make_shared<RestrictedSource>(source_, view);
  shared = restricted;
  return restricted;
}

Author Visitors::author_of(const Visitor& visitor) {
  // Who looks with the eyes of another has given up the powers of a super-user meanwhile.
  return {known_as(visitor.person).name, visitor.person.role == Role::kSuperUser && !visitor.eyes,
          visitor.number};
}

void Visitors::show_to(Visitor& visitor, bool same_run) {
  Greeting greeting{visitor.eyes.value_or(visitor.person), {}};
  if (visitor.eyes) greeting.seen_by = visitor.person;
  greeting.author = author_of(visitor);
  greeting.foxglove = foxglove_;
  greeting.conducts = conducts_runs(visitor);
  visitor.page->show(source_for(visitor.view), greeting, same_run, texts_);
  visitor.page->send(payload(
      room_.text_for({known_as(visitor.eyes.value_or(visitor.person)), *visitor.view}, 0, true)));
  visitor.told_chat = room_.newest();
  // The page has forgotten them.
  visitor.told_accounts = visitor.told_audit = visitor.told_conduct = 0;
  told_people_.clear();
}

void Visitors::show_again_if_other() {
  if (!source_) return;
  for (auto& [id, visitor] : visitors_) {
    auto view = desk_.view_of(visitor.eyes.value_or(visitor.person));
    const bool same = visitor.view && view->key() == visitor.view->key();
    if (same) continue;
    visitor.view = std::move(view);
    show_to(visitor, true);
  }
  std::erase_if(restricted_, [](const auto& entry) { return entry.second.expired(); });
}

void Visitors::tell_rights() {
  web::Payload message;
  for (const auto& [id, visitor] : visitors_) {
    if (!visitor.conducts()) continue;
    if (!message) message = std::make_shared<const std::string>(desk_.message(people()));
    visitor.page->send(message);
  }
}

void Visitors::tick(Audience audience) {
  if (!source_) return;
  const auto now = Session::Clock::now();
  for (const auto& [id, visitor] : visitors_) {
    const LookMessage& look = visitor.page->look();
    if (look.poses) audience.max_hz = std::max(audience.max_hz, look.max_hz);
    audience.parts = audience.parts || look.parts;
    audience.truth = audience.truth || (look.poses && look.true_poses &&
                                        visitor.view->may_some(InfoClass::kTruePose));
    for (const LookedAt& looked : look.readings) {
      // What is withheld is not even gathered.
      const auto robot = visitor.view->robot_of(looked.slot);
      if (robot && visitor.view->may_read_sensor(*robot, looked.sensor)) {
        audience.looked_at.push_back({*robot, looked.sensor});
      }
    }
    for (const MapName& map : visitor.page->looked_at_maps()) {
      const auto robot = visitor.view->robot_of(map.slot);
      if (robot && visitor.view->may(InfoClass::kMaps, *robot)) audience.maps.push_back(*robot);
    }
    for (const ProbeShown& probe : visitor.page->looked_at_probes()) {
      if (visitor.view->may(InfoClass::kProbe, probe.asked.robot)) {
        audience.probes.push_back(probe.asked);
      }
    }
  }
  // In a fixed order, because sources compare it with what was asked for before.
  std::sort(audience.probes.begin(), audience.probes.end());
  std::sort(audience.maps.begin(), audience.maps.end());
  audience.maps.erase(std::unique(audience.maps.begin(), audience.maps.end()), audience.maps.end());
  auto& looked_at = audience.looked_at;
  std::sort(looked_at.begin(), looked_at.end());
  looked_at.erase(std::unique(looked_at.begin(), looked_at.end()), looked_at.end());
  source_->tick(now, audience);
  SharedFrames frames;
  for (auto& [id, visitor] : visitors_) visitor.page->tick(now, frames);
  tell_chat();
  tell_people();
}

void Visitors::tell_chat() {
  for (auto& [id, visitor] : visitors_) {
    if (visitor.told_chat == room_.newest()) continue;
    std::string text = room_.text_for(
        {known_as(visitor.eyes.value_or(visitor.person)), *visitor.view}, visitor.told_chat, false);
    visitor.told_chat = room_.newest();
    if (!text.empty()) visitor.page->send(payload(std::move(text)));
  }
}

/// Who is there: to those who may talk.
void Visitors::tell_people() {
  // Emptied by whatever changes who is there.
  if (!told_people_.empty()) return;
  std::map<std::string, std::string_view> there;
  for (const auto& [id, visitor] : visitors_) {
    there[known_as(visitor.person).name] = to_string(visitor.person.role);
  }
  nlohmann::ordered_json message = {{"type", "people"},
                                    {"people", nlohmann::ordered_json::array()}};
  for (const auto& [name, role] : there)
    message["people"].push_back({{"name", name}, {"role", role}});
  told_people_ = message.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  const web::Payload text = payload(told_people_);
  for (const auto& [id, visitor] : visitors_) {
    if (visitor.view->may_any(InfoClass::kChat)) visitor.page->send(text);
  }
}

void Visitors::check() {
  give_teams();
  // `rave people` may change the accounts at any time.
  const Status read = door_.refresh();
  const std::string trouble = read ? "" : read.error().text();
  // Noted once, not twice a second for as long as it lasts.
  if (!trouble.empty() && trouble != trouble_) audit_->note("accounts", {{"why", trouble}});
  trouble_ = trouble;
  bool changed = false;
  for (auto& [id, visitor] : visitors_) {
    const auto person = door_.whose(visitor.session);
    if (!person) {
      visitor.socket->close(kSignedOut, "You are signed out");
      continue;
    }
    if (*person == visitor.person) continue;
    visitor.person = *person;
    if (person->role != Role::kSuperUser) visitor.eyes.reset();
    visitor.page->set_author(author_of(visitor));
    changed = true;
    if (!source_) continue;
    // Also if the rights are the same: the page shows the role.
    visitor.view = desk_.view_of(visitor.eyes.value_or(visitor.person));
    show_to(visitor, true);
  }
  if (changed) {
    std::erase_if(restricted_, [](const auto& entry) { return entry.second.expired(); });
    ++accounts_news_;
  }
  if (accounts_revision_ != people_desk_.revision()) {
    accounts_revision_ = people_desk_.revision();
    note_arrivals();
    ++accounts_news_;
    changed = true;
  }
  if (source_ && changed) tell_rights();
  tell_accounts();
  tell_conduct();
}

std::shared_ptr<const View> Visitors::view_of(const Person& person) {
  return source_ ? desk_.view_of(person) : nullptr;
}

Person Visitors::known(const Person& person) { return known_as(person); }

bool Visitors::sees_as_other(std::string_view session) const {
  return std::ranges::any_of(visitors_, [session](const auto& entry) {
    return entry.second.session == session && entry.second.eyes.has_value();
  });
}

SessionCalls Visitors::calls_of(std::uint64_t id) {
  SessionCalls calls;
  calls.set_right = [this, id](const RightChange& change) { return set_right(id, change); };
  calls.see_as = [this, id](const SeeAsMessage& see) { return see_as(id, see); };
  calls.commanded = [this, id](const CommandMessage& command, const PageAnswer& answer) {
    note_command(id, command, answer);
  };
  calls.may_give = [this, id](const CommandMessage& give) { return may_give(id, give); };
  calls.people = [this, id](const PeopleMessage& asked) { take_people(id, asked); };
  calls.conduct = [this, id](const ConductMessage& asked) { take_conduct(id, asked); };
  calls.malformed = [this, id](std::string_view why, bool cut) { note_malformed(id, why, cut); };
  calls.page_key = [this, id](const PageKeyMessage& page) {
    const auto found = visitors_.find(id);
    if (found == visitors_.end()) return;
    found->second.number = direct_line::page_number(page.key);
    found->second.page->set_author(author_of(found->second));
  };
  calls.chat = [this, id](const ChatMessage& said) { return chat(id, said); };
  calls.halted = [this, id](const HaltMessage& halt, bool good) {
    const auto found = visitors_.find(id);
    if (found == visitors_.end()) return;
    audit_->note(halt.stop ? "stop" : "release",
                 {{"user", found->second.person.name}, {"detail", halt_text(halt, good)}});
  };
  return calls;
}

void Visitors::note_command(std::uint64_t id, const CommandMessage& command,
                            const PageAnswer& answer) {
  const auto found = visitors_.find(id);
  if (found == visitors_.end()) return;
  const std::string detail = command_text(command, answer);
  if (answer.good) {
    audit_->note("order", {{"user", found->second.person.name}, {"detail", detail}});
  } else {
    audit_->note("refused",
                 {{"why", "order"}, {"user", found->second.person.name}, {"detail", detail}});
  }
}

Result<std::string> Visitors::set_right(std::uint64_t id, const RightChange& change) {
  const Visitor& visitor = visitors_.at(id);
  if (!visitor.conducts()) {
    audit_->note("refused", {{"why", "right"}, {"user", visitor.person.name}});
    return fail(ErrorCode::kState, "{}", kSuperUsersOnly);
  }
  if (!source_) return fail(ErrorCode::kState, "No run is in progress.");
  const Status changed = desk_.change(change);
  // A change that could not be written holds all the same, until the server ends: it is noted and
  // shown before the error is sent.
  if (!changed && changed.error().code != ErrorCode::kIo) return tl::unexpected(changed.error());
  door_.keep_names(desk_.mentioned());
  if (!change.role && change.reach) people_desk_.give_name(change.user);
  audit_->note("right", {{"user", visitor.person.name}, {"detail", right_text(change)}});
  show_again_if_other();
  tell_rights();
  if (!changed) return tl::unexpected(changed.error());
  return right_text(change);
}

Result<std::string> Visitors::see_as(std::uint64_t id, const SeeAsMessage& see) {
  Visitor& visitor = visitors_.at(id);
  if (visitor.person.role != Role::kSuperUser)
    return fail(ErrorCode::kState, "{}", kSuperUsersOnly);
  std::optional<Person> eyes;
  if (see.role) {
    eyes = Person{std::string(to_string(*see.role)), *see.role, {}};
  } else if (!see.user.empty()) {
    for (const Person& person : people()) {
      if (person.name == see.user) eyes = person;
    }
    if (!eyes) return fail(ErrorCode::kNotFound, "There is no user `{}`.", see.user);
  }
  audit_->note("see_as", {{"user", visitor.person.name}, {"detail", eyes ? eyes->name : "self"}});
  visitor.eyes = std::move(eyes);
  if (!source_) return std::string();
  visitor.view = desk_.view_of(visitor.eyes.value_or(visitor.person));
  show_to(visitor, true);
  if (!visitor.eyes) tell_rights();
  tell_accounts();
  return std::string();
}

std::vector<Person> Visitors::people() const {
  std::vector<Person> people;
  if (!accounts_) return people;
  for (const Account& account : accounts_->state().accounts) people.push_back(account.person);
  return people;
}

}  // namespace rave::gui_server
