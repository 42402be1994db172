// SPDX-License-Identifier: Apache-2.0
#include "chat_room.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace rave::gui_server {
namespace {

const char* to_word(ChatMessage::To to) {
  switch (to) {
    case ChatMessage::To::kAll:
      return "all";
    case ChatMessage::To::kRole:
      return "role";
    case ChatMessage::To::kUser:
      return "user";
    case ChatMessage::To::kTeam:
      return "team";
    case ChatMessage::To::kRobot:
      return "robot";
  }
  return "all";
}

}  // namespace

Status ChatRoom::say(Line line, std::chrono::steady_clock::time_point now) {
  if (!limit_.take(line.from.name, now)) {
    return fail(ErrorCode::kState, "Too many messages at once: wait a moment.");
  }
  line.number = ++numbered_;
  lines_.push_back(std::move(line));
  if (lines_.size() > kMostLines) lines_.pop_front();
  return {};
}

bool ChatRoom::hears(const Listener& listener, const Line& line) {
  const auto& [person, view] = listener;
  if (person.name == line.from.name) return true;
  switch (line.to) {
    case ChatMessage::To::kUser:
      return person.name == line.name;
    case ChatMessage::To::kRole:
      return view.may_any(InfoClass::kChat) &&
             (to_string(person.role) == line.name || person.role == Role::kSuperUser);
    case ChatMessage::To::kAll:
      return view.may_any(InfoClass::kChat);
    case ChatMessage::To::kTeam:
    case ChatMessage::To::kRobot:
      return std::any_of(line.robots.begin(), line.robots.end(), [&view](std::uint32_t robot) {
        return view.may(InfoClass::kChat, robot);
      });
  }
  return false;
}

std::string ChatRoom::text_for(const Listener& listener, std::uint64_t number, bool all) const {
  nlohmann::ordered_json message = {
      {"type", "chat"}, {"reset", all}, {"lines", nlohmann::ordered_json::array()}};
  for (const Line& line : lines_) {
    if (line.number <= number || !hears(listener, line)) continue;
    message["lines"].push_back(
        {{"number", line.number},
         {"t", line.t_s},
         {"from", {{"name", line.from.name}, {"role", to_string(line.from.role)}}},
         {"yours", line.from.name == listener.person.name},
         {"to", to_word(line.to)},
         {"name", line.name},
         {"text", line.text}});
  }
  if (!all && message["lines"].empty()) return {};
  return message.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace rave::gui_server
