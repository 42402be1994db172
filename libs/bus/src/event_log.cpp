// SPDX-License-Identifier: Apache-2.0
// Which events of the bus are worth a line of the log, and how many lines.
#include "rave/bus/event_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "rave/base/control_characters.hpp"
#include "rave/base/utf8.hpp"

namespace rave::bus {
namespace {

/// Bounds the memory if a sender invents writer ids.
constexpr std::size_t kMostWriters = 1000;

/// The text with `?` for invalid UTF-8 and control characters.
std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const TextCharacter character = character_at(text, at);
    const std::string_view bytes = text.substr(at, character.bytes);
    if (result.size() + bytes.size() > EventLog::kMostBytes) return result + "...";
    result += character.control || utf8_at(text, at).length == 0 ? std::string_view("?") : bytes;
    at += character.bytes;
  }
  return result;
}

}  // namespace

void EventLog::note(const BusEvent& event, Clock::time_point now) {
  using enum EventKind;
  const bool worth = event.kind == kRefused || event.kind == kIncompatible ||
                     event.kind == kForeignRun || event.kind == kNotice ||
                     event.kind == kStoodStill;
  if (!worth || log_ == nullptr) return;
  std::string line = event.line();
  const auto told = told_.find(event.writer);
  // A faulty sender causes the same event with each of its samples; it is reported once, until
  // something else is worth telling of that sender.
  if (told != told_.end() && told->second == line) return;
  write(LogLevel::kWarning, "bus", line, now);
  if (told_.size() >= kMostWriters && told == told_.end()) told_.erase(told_.begin());
  told_[event.writer] = std::move(line);
}

void EventLog::write(LogLevel level, std::string_view source, std::string_view text,
                     Clock::time_point now) {
  if (log_ == nullptr) return;
  if (!budget_.take(now)) {
    ++left_out_;
    return;
  }
  std::string line = printable(text);
  if (const std::uint64_t left_out = std::exchange(left_out_, 0); left_out > 0) {
    line += fmt::format(" ({} more lines about other processes were left out)", left_out);
  }
  log_->write(level, source, line);
}

}  // namespace rave::bus
