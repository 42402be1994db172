// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "page/page_message.hpp"
#include "rave/gui_server/person.hpp"
#include "rave/gui_server/source.hpp"
#include "rave/web/rate_limit.hpp"
#include "visitors/view.hpp"

namespace rave::gui_server {

/// What people have said to each other and to robots since the server began, and what the record of
/// the run has that is shown; the newest 500 lines. The thread of the server.
class ChatRoom {
 public:
  static constexpr std::size_t kMostLines = 500;

  struct Line {
    std::uint64_t number = 0;  ///< From 1 on.
    double t_s = 0;            ///< Of the run.
    Person from;
    ChatMessage::To to = ChatMessage::To::kAll;
    std::string name;                   ///< Of the role, user, team or robot that it is for.
    std::vector<std::uint32_t> robots;  ///< That it is for, as the run counts them.
    std::string text;
    /// Arrivals before it was said; 0: it comes from a record. See arrived().
    std::uint64_t era = 0;
  };
  /// A person as the room sees them.
  struct Listener {
    const Person& person;
    const View& view;
  };

  /// Error: kState (too much at once).
  [[nodiscard]] Status say(Line line, std::chrono::steady_clock::time_point now);
  /// Shows lines of a record before those that were said here, which it may have, too; the numbers
  /// are others then. `cast`: the robots of its run.
  void begin(std::span<const ChatText> recorded, const Cast& cast);
  [[nodiscard]] const Line& last() const { return lines_.back(); }
  /// A line as a record has it; and back, with the robots that it is for. Nothing: it is none.
  [[nodiscard]] static ChatText text_of(const Line& line);
  [[nodiscard]] static std::optional<Line> line_of(const ChatText& text, const Cast& cast);
  /// The message `chat` with the lines after `number` that a person may read; empty: there are
  /// none. `all`: the page forgets those that it had.
  [[nodiscard]] std::string text_for(const Listener& listener, std::uint64_t number,
                                     bool all) const;
  [[nodiscard]] std::uint64_t newest() const noexcept { return numbered_; }
  [[nodiscard]] bool hears(const Listener& listener, const Line& line) const;
  /// A new person has this name, which they may have chosen: private lines of who had it before are
  /// not for them.
  void arrived(const std::string& name);

 private:
  /// Whether the name in a line means this person.
  [[nodiscard]] bool means(const std::string& name, const Line& line, const Person& person) const;

  std::uint64_t era_ = 1;
  std::map<std::string, std::uint64_t, std::less<>> arrivals_;  ///< The era of each, by name.
  std::deque<Line> lines_;
  std::uint64_t numbered_ = 0;
  web::RateLimit limit_{2, 20};
};

}  // namespace rave::gui_server
