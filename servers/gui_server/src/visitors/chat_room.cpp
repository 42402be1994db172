// SPDX-License-Identifier: Apache-2.0
#include "visitors/chat_room.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "rave/base/json_text.hpp"

namespace rave::gui_server {
namespace {

bool same_words(const ChatRoom::Line& a, const ChatRoom::Line& b) {
  return a.from.name == b.from.name && a.to == b.to && a.name == b.name && a.text == b.text;
}

}  // namespace

ChatText ChatRoom::text_of(const Line& line) {
  return {line.number,
          line.t_s,
          line.from.name,
          std::string(to_string(line.from.role)),
          std::string(kChatTo.of(line.to)),
          line.name,
          line.text};
}

std::optional<ChatRoom::Line> ChatRoom::line_of(const ChatText& text, const Cast& cast) {
  const auto role = kRoles.find(text.role);
  const auto to = kChatTo.find(text.to);
  if (!role || !to) return std::nullopt;
  Line line;
  line.t_s = text.t_s;
  line.from.name = text.from;
  line.from.role = *role;
  line.to = *to;
  line.name = text.name;
  line.text = text.text;
  for (std::uint32_t robot = 0; robot < cast.names.size(); ++robot) {
    // Which robots a line concerns is not recorded: it follows from names, as when it was said.
    const bool meant = (line.to == ChatMessage::To::kRobot && cast.names[robot] == line.name) ||
                       (line.to == ChatMessage::To::kTeam && cast.teams[robot] == line.name);
    if (meant) line.robots.push_back(robot);
  }
  return line;
}

void ChatRoom::begin(std::span<const ChatText> recorded, const Cast& cast) {
  std::deque<Line> all;
  for (const ChatText& text : recorded) {
    if (auto line = line_of(text, cast)) all.push_back(*std::move(line));
  }
  const std::size_t of_record = all.size();
  for (Line& line : lines_) {
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(of_record);
    // What was said while it was recorded is in both; the line of the recording wins, since it has
    // the time of the run.
    const auto known = std::find_if(all.begin(), end,
                                    [&line](const Line& other) { return same_words(line, other); });
    if (known != end) {
      known->era = line.era;
    } else {
      all.push_back(std::move(line));
    }
  }
  while (all.size() > kMostLines) all.pop_front();
  // Numbers continue, so that no page takes a new line for one that it has.
  for (Line& line : all) line.number = ++numbered_;
  lines_ = std::move(all);
}

Status ChatRoom::say(Line line, std::chrono::steady_clock::time_point now) {
  if (!limit_.take(line.from.name, now)) {
    return fail(ErrorCode::kState, "Too many messages at once: wait a moment.");
  }
  line.number = ++numbered_;
  line.era = era_;
  lines_.push_back(std::move(line));
  if (lines_.size() > kMostLines) lines_.pop_front();
  return {};
}

void ChatRoom::arrived(const std::string& name) { arrivals_[name] = ++era_; }

bool ChatRoom::means(const std::string& name, const Line& line, const Person& person) const {
  if (person.name != name) return false;
  // A name that was given stays with its person, and with a record of what they said.
  if (person.name_given) return true;
  const auto arrival = arrivals_.find(name);
  return line.era >= (arrival == arrivals_.end() ? 1 : arrival->second);
}

bool ChatRoom::hears(const Listener& listener, const Line& line) const {
  const auto& [person, view] = listener;
  // The sender sees what was said, whatever the rights of the sender are.
  if (means(line.from.name, line, person)) return true;
  switch (line.to) {
    case ChatMessage::To::kUser:
      // A line to one person needs no right: the sender chose the receiver.
      return means(line.name, line, person);
    case ChatMessage::To::kRole:
      return view.may_any(InfoClass::kChat) &&
             // Super-users see the lines of all roles.
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
         {"yours", means(line.from.name, line, listener.person)},
         {"to", kChatTo.of(line.to)},
         {"name", line.name},
         {"text", line.text}});
  }
  // No message, where none of the new lines is for this listener. With `all` an empty list empties
  // the page.
  if (!all && message["lines"].empty()) return {};
  return json_text(message);
}

}  // namespace rave::gui_server
