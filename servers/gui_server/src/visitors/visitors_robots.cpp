// SPDX-License-Identifier: Apache-2.0
// What visitors say to people and robots.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <vector>

#include "rave/base/names.hpp"
#include "visitors/visitors.hpp"

namespace rave::gui_server {

Result<std::string> Visitors::chat(std::uint64_t id, const ChatMessage& chat) {
  using To = ChatMessage::To;
  Visitor& visitor = visitors_.at(id);
  if (visitor.eyes)
    return fail(ErrorCode::kState, "While you view the page as another user, you can only watch.");
  if (!source_) return fail(ErrorCode::kState, "No run is in progress.");
  if (!visitor.view->may_any(InfoClass::kChat)) {
    return fail(ErrorCode::kState, "Your rights do not include this.");
  }
  ChatRoom::Line line;
  line.from = known(visitor.person);
  line.to = chat.to;
  line.name = chat.name;
  line.text = chat.text;
  line.t_s = source_->open_playhead()->look(Session::Clock::now()).now_s;
  const Cast& cast = desk_.cast();
  CommandMessage told;
  told.action = request::Text{chat.text};
  for (std::uint32_t slot = 0; slot < visitor.view->robots(); ++slot) {
    const std::uint32_t robot = *visitor.view->robot_of(slot);
    const bool meant = (chat.to == To::kRobot && slot == chat.slot) ||
                       (chat.to == To::kTeam && cast.teams[robot] == chat.name);
    if (!meant || !visitor.view->may(InfoClass::kChat, robot)) continue;
    line.robots.push_back(robot);
    if (chat.to == To::kRobot) line.name = cast.names[robot];
    if (source_->about().live && visitor.view->may(InfoClass::kCommand, robot)) {
      told.slots.push_back(slot);
    }
  }
  if ((chat.to == To::kRobot || chat.to == To::kTeam) && line.robots.empty()) {
    return fail(ErrorCode::kNotFound, "There is no such robot or team.");
  }
  if (chat.to == To::kUser && !is_there(chat.name)) {
    return fail(ErrorCode::kNotFound, "`{}` is not connected.", chat.name);
  }
  const std::size_t robots = std::min(told.slots.size(), kMostCommanded);
  told.slots.resize(robots);
  told.request = chat.request;
  RAVE_TRY(room_.say(std::move(line), Session::Clock::now()));
  source_->keep_chat(ChatRoom::text_of(room_.last()));
  if (robots > 0) visitor.page->command(told);
  return robots > 0 ? fmt::format("Sent to {} robots.", robots) : std::string("Said.");
}

Status Visitors::may_give(std::uint64_t id, const CommandMessage& give) const {
  const Visitor& giver = visitors_.at(id);
  const std::string own = known(giver.person).name;
  const auto* const gift = give.as<request::Give>();
  if (gift == nullptr || gift->to == own || !giver.view) return {};
  std::set<std::string> able;
  for (const auto& [other, visitor] : visitors_) {
    // Who looks with the eyes of another commands nothing meanwhile.
    if (visitor.eyes || !visitor.view) continue;
    const bool commands = std::ranges::all_of(give.slots, [&](std::uint32_t slot) {
      const auto robot = giver.view->robot_of(slot);
      return robot && visitor.view->may(InfoClass::kCommand, *robot);
    });
    if (commands) able.insert(known(visitor.person).name);
  }
  if (able.contains(gift->to)) return {};
  able.erase(own);
  const char* const robots = give.slots.size() == 1 ? "this robot" : "these robots";
  return fail(
      ErrorCode::kNotFound, "`{}` {}; {}", gift->to,
      is_there(gift->to) ? fmt::format("may not command {}", robots) : "is not here",
      able.empty()
          ? fmt::format("no other person who may command {} is here", robots)
          : fmt::format("{} can be given to {}", robots,
                        join_names(std::vector<std::string_view>(able.begin(), able.end()), "or")));
}

bool Visitors::is_there(const std::string& name) const {
  return std::any_of(visitors_.begin(), visitors_.end(), [&name](const auto& entry) {
    return known(entry.second.person).name == name;
  });
}

}  // namespace rave::gui_server
