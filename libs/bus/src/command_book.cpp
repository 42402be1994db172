// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/command_book.hpp"

#include <algorithm>

namespace rave::bus {
namespace {

/// Minimum interval between warnings of too many commands.
constexpr std::chrono::seconds kWarnEvery{1};

}  // namespace

void CommandBook::hear(const Command& command, Clock::time_point now) {
  const bool stop = command.kind == rave_wire_COMMAND_STOP;
  // A flood of orders must not keep a robot from being stopped.
  if (!budget_.take(now) && !stop) {
    // No answer: the sender repeats what needs one, and a drive is renewed anyway.
    if (log_ != nullptr && (!warned_ || now - *warned_ >= kWarnEvery)) {
      warned_ = now;
      log_->warn("by hand", "more than {} commands per second over the bus, the last by `{}`",
                 kPerSecond, command.author);
    }
    return;
  }
  // Limits the memory that a sender with invented writer ids can use.
  if (known_.size() >= kMostKnown) {
    std::erase_if(known_, [](const auto& entry) { return entry.second.open == 0; });
  }
  const Key key(command.writer, command.robot);
  Known& known = known_[key];
  if (command.number <= known.newest) return hear_again(command, known);
  const bool drive = command.kind == rave_wire_COMMAND_DRIVE;
  if (!drive && !stop && open_.size() >= kMostOpen) {
    refuse(command, "too many orders are waiting; try again later");
    return;
  }
  known.newest = command.number;
  BegunCommand begun = begin_(command);
  if (!begun) return;
  ++known.open;
  open_.push_back({key, command.number, std::move(begun)});
}

/// An old command must not undo a newer one. Its sender waits for an answer, so it gets one.
void CommandBook::hear_again(const Command& command, const Known& known) {
  if (command.kind == rave_wire_COMMAND_DRIVE) return;
  const auto kept = std::ranges::find(known.kept, command.number, &Reply::number);
  if (kept != known.kept.end()) {
    replies_.push_back(*kept);
    return;
  }
  const bool waits = std::ranges::any_of(open_, [&command](const Open& open) {
    return open.key == Key(command.writer, command.robot) && open.number == command.number;
  });
  if (waits || command.number == known.newest) return;
  refuse(command, "the command arrived after a newer one for the same robot");
}

void CommandBook::refuse(const Command& command, const char* why) {
  replies_.push_back({command.writer, command.robot, command.number, {false, why}});
}

std::vector<CommandBook::Reply> CommandBook::take() {
  std::erase_if(open_, [this](Open& one) {
    auto result = one.begun();
    if (!result) return false;
    Known& known = known_[one.key];
    if (known.open > 0) --known.open;
    if (known.kept.size() >= kMostKept) known.kept.pop_front();
    known.kept.push_back({one.key.first, one.key.second, one.number, *std::move(result)});
    replies_.push_back(known.kept.back());
    return true;
  });
  return std::exchange(replies_, {});
}

}  // namespace rave::bus
