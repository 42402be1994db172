// SPDX-License-Identifier: Apache-2.0
// Which events of the bus are worth a line of the log, and how many lines.
#include "rave/bus/event_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "rave/base/control_characters.hpp"

namespace rave::bus {
namespace {

constexpr std::chrono::seconds kPerLine{1};
/// Bounds the memory if a sender invents writer ids.
constexpr std::size_t kMostWriters = 1000;

/// Whether the bytes of one character (see character_at()) are not valid UTF-8 (RFC 3629, section
/// 4).
bool broken(std::string_view bytes) {
  const auto byte = [bytes](std::size_t at) { return static_cast<unsigned char>(bytes[at]); };
  const unsigned first = byte(0);
  if (bytes.size() == 1) return first >= 0x80;
  const unsigned second = byte(1);
  return first < 0xc2 || first > 0xf4 || (first == 0xe0 && second < 0xa0) ||
         (first == 0xed && second > 0x9f) || (first == 0xf0 && second < 0x90) ||
         (first == 0xf4 && second > 0x8f);
}

/// The text with `?` for invalid UTF-8 and control characters.
std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const TextCharacter character = character_at(text, at);
    const std::string_view bytes = text.substr(at, character.bytes);
    if (result.size() + bytes.size() > EventLog::kMostBytes) return result + "...";
    result += character.control || broken(bytes) ? std::string_view("?") : bytes;
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
  if (!may_write(now)) {
    ++left_out_;
    return;
  }
  std::string line = printable(text);
  if (const std::uint64_t left_out = std::exchange(left_out_, 0); left_out > 0) {
    line += fmt::format(" ({} more lines about other processes were left out)", left_out);
  }
  log_->write(level, source, line);
}

// A budget that refills by a line per second: other processes must not be able to fill the log.
bool EventLog::may_write(Clock::time_point now) {
  if (now - refilled_ >= kPerLine) {
    const auto lines = static_cast<std::size_t>((now - refilled_) / kPerLine);
    budget_ = std::min(kAtOnce, budget_ + std::min(lines, kAtOnce));
    refilled_ = now;
  }
  if (budget_ == 0) return false;
  --budget_;
  return true;
}

}  // namespace rave::bus
