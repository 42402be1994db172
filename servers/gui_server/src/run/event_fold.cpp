// SPDX-License-Identifier: Apache-2.0
#include "run/event_fold.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rave::gui_server {
namespace {

/// What repeats within this time is one event that continues.
constexpr double kFold_s = 5;

LogEvent::Level level_of(std::string_view kind) {
  for (const std::string_view bad : {"program failed", "driver failed", "pinned", "process lost"}) {
    if (kind == bad) return LogEvent::Level::kAlert;
  }
  for (const std::string_view odd :
       {"pose stale", "guard stopped", "guard slowed", "change refused", "stopped",
        "hand over refused", "panels not changed", "pose refused", "sensor restarted",
        // Who commands whom must not be lost among contacts.
        "disarmed", "team given"}) {
    if (kind == odd) return LogEvent::Level::kWarn;
  }
  return LogEvent::Level::kInfo;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  return text;
}

}  // namespace

EventFold::EventFold(std::vector<std::string> names) : names_(std::move(names)) {
  for (std::uint32_t slot = 0; slot < names_.size(); ++slot) slots_.emplace(names_[slot], slot);
}

void EventFold::add(double t_s, int slot, std::string_view kind, std::string_view text) {
  LogEvent event;
  event.t_s = event.until_s = t_s;
  event.kind = kind;
  event.level = level_of(kind);
  std::string_view rest = trimmed(text);
  std::string subject;
  if (slot >= 0 && static_cast<std::size_t>(slot) < names_.size()) {
    subject = names_[static_cast<std::size_t>(slot)];
    event.slots.push_back(static_cast<std::uint32_t>(slot));
  }
  // Texts of contacts begin with "with NAME", some with a colon and details behind it.
  if (rest.starts_with("with ")) {
    rest.remove_prefix(5);
    std::string other(trimmed(rest.substr(0, rest.find(':'))));
    const auto known = slots_.find(other);
    if (known != slots_.end()) event.slots.push_back(known->second);
    // Of two robots that touch each other each has an event; they are one.
    if (known != slots_.end() && other < subject) std::swap(subject, other);
    std::sort(event.slots.begin(), event.slots.end());
    event.text = kind == "contact" ? fmt::format("{} and {} touch", subject, other)
                                   : fmt::format("{}: {} with {}", subject, kind, other);
  } else if (subject.empty()) {
    event.text = rest.empty() ? std::string(kind) : fmt::format("{}: {}", kind, rest);
  } else {
    event.text = rest.empty() ? fmt::format("{}: {}", subject, kind)
                              : fmt::format("{}: {}, {}", subject, kind, rest);
  }
  // The text is the key: it has names, kind and details, so equal texts are repetitions.
  const auto last = last_.find(event.text);
  if (last != last_.end() && t_s - events_[last->second].until_s <= kFold_s) {
    events_[last->second].until_s = t_s;
    ++events_[last->second].count;
    changed_[last->second] = ++revision_;
    return;
  }
  // Warnings and alerts have room of their own, which a flood of contacts cannot take.
  if (events_.size() >= (event.level == LogEvent::Level::kInfo ? kMostEvents : kMostInAll)) {
    return leave_out(t_s);
  }
  last_[event.text] = events_.size();
  events_.push_back(std::move(event));
  changed_.push_back(++revision_);
}

void EventFold::leave_out(double t_s) {
  if (left_out_++ == 0) {
    full_ = events_.size();
    LogEvent& row = events_.emplace_back();
    row.t_s = t_s;
    row.kind = "log full";
    row.level = LogEvent::Level::kWarn;
    changed_.push_back(0);
  }
  LogEvent& row = events_[full_];
  row.until_s = t_s;
  row.text = fmt::format("the log is full: {} more events are not shown; the recording has them",
                         left_out_);
  changed_[full_] = ++revision_;
}

std::size_t EventFold::changed_since(std::uint64_t revision) const noexcept {
  if (revision >= revision_) return events_.size();
  const auto first = std::find_if(changed_.begin(), changed_.end(),
                                  [=](std::uint64_t changed) { return changed > revision; });
  return static_cast<std::size_t>(first - changed_.begin());
}

}  // namespace rave::gui_server
