// SPDX-License-Identifier: Apache-2.0
#include "page/page_commands.hpp"

#include <fmt/format.h>

#include <utility>

namespace rave::gui_server {
namespace {

/// The run lets a robot stand whose driver is silent for 200 ms. To say so once more would take the
/// robot from its program, or from the person who drives it since.
constexpr std::chrono::seconds kStandsAnyway{1};

/// The person who orders it has the lease then.
bool takes_lease(const CommandMessage& command) {
  return request::is_order(command.action) || command.is<request::Take>();
}

}  // namespace

/// A message whose robots have not all answered.
struct PageCommands::Open {
  CommandMessage command;
  std::size_t missing = 0;
  PageAnswer answer;
};

PageCommands::PageCommands(Say say, Told told, MayGive may_give)
    : say_(std::move(say)), told_(std::move(told)), may_give_(std::move(may_give)) {}

void PageCommands::begin(std::shared_ptr<Source> source, Author author) {
  let_go();
  source_ = std::move(source);
  author_ = std::move(author);
  waiting_ = 0;
  newest_.reset();
  // Answers of the previous run have no receiver any more.
  alive_ = std::make_shared<bool>(true);
}

void PageCommands::let_go() {
  newest_.reset();
  CommandMessage stand;
  stand.action = request::Drive();
  const auto now = web::RateLimit::Clock::now();
  for (const auto& [slot, since] : driven_) {
    if (now - since < kStandsAnyway) stand.slots.push_back(slot);
  }
  driven_.clear();
  if (!stand.slots.empty() && source_) {
    source_->command(stand, author_, [](std::uint32_t, bool, const std::string&) {});
  }
  leave();
}

void PageCommands::leave() {
  // Leases from before a restart of the server; those of direct lines their hosts leave.
  if (source_ && source_->about().relay) {
    for (const DriveState& state : source_->leases_changed_since(0)) {
      if (state.page != 0 && state.is_of(author_)) ordered_.insert(state.slot);
    }
  }
  if (!ordered_.empty()) {
    CommandMessage leave;
    leave.action = request::Give{author_.name};
    leave.slots.assign(ordered_.begin(), ordered_.end());
    // Refused where it has the lease no more.
    source_->command(leave, author_, [](std::uint32_t, bool, const std::string&) {});
  }
  ordered_.clear();
}

bool PageCommands::too_many(const CommandMessage& command) {
  const auto now = web::RateLimit::Clock::now();
  const std::size_t count = std::max<std::size_t>(1, command.slots.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (!limit_.take("", now)) return true;
  }
  return false;
}

void PageCommands::take(const CommandMessage& command) {
  const std::string to(command.name());
  if (!source_) return say_({to, false, "No run is in progress.", command.request});
  // To stand is never too much.
  if (!command.stands() && too_many(command)) {
    const PageAnswer answer{
        to, false, fmt::format("Too many orders: at most {} robots per second.", kPerSecond),
        command.request};
    say_(answer);
    told_(command, answer);
    return;
  }
  const auto* const gift = command.as<request::Give>();
  const bool gives = gift != nullptr && !gift->to.empty();
  if (const Status may = gives && may_give_ ? may_give_(command) : Status(); !may) {
    const PageAnswer answer{to, false, may.error().message, command.request};
    say_(answer);
    told_(command, answer);
    return;
  }
  if (command.is<request::Drive>()) {
    for (const std::uint32_t slot : command.slots) {
      if (command.stands()) {
        driven_.erase(slot);
      } else {
        driven_[slot] = web::RateLimit::Clock::now();
      }
    }
    if (waiting_ >= kMostWaiting && !command.stands()) {
      newest_ = command;
      return;
    }
    newest_.reset();
  }
  post(command);
}

void PageCommands::set_author(Author author) {
  // Leases are those of a page, and for the run this is another one now.
  if (author.page != author_.page) leave();
  author_ = std::move(author);
}

/// Refused orders, too: the page may have the lease from before.
void PageCommands::remember(const CommandMessage& command) {
  for (const std::uint32_t slot : command.slots) {
    // Who sends wrong slots must not fill the memory.
    if (takes_lease(command) && slot < source_->robot_count()) ordered_.insert(slot);
    if (command.is<request::Give>()) ordered_.erase(slot);
  }
}

void PageCommands::post(const CommandMessage& command) {
  remember(command);
  auto open = std::make_shared<Open>();
  open->command = command;
  open->missing = std::max<std::size_t>(1, command.slots.size());
  open->answer = {std::string(command.name()), true, "", command.request};
  if (command.is<request::Drive>()) ++waiting_;
  source_->command(
      command, author_,
      [this, open, alive = std::weak_ptr(alive_)](std::uint32_t slot, bool good,
                                                  const std::string& text) {
        if (alive.expired() || open->missing == 0) return;
        if (!good) {
          open->answer.good = false;
          if (slot != Source::kNoSlot) open->answer.refused.emplace_back(slot, text);
        }
        // The first reason is said, or what was done last.
        if (open->answer.good || open->answer.text.empty() || open->answer.refused.size() == 1) {
          open->answer.text = text;
        }
        if (--open->missing == 0) finish(*open);
      });
}

void PageCommands::finish(const Open& open) {
  const bool drive = open.command.is<request::Drive>();
  if (drive) {
    --waiting_;
    for (const auto& [slot, text] : open.answer.refused) driven_.erase(slot);
  }
  say_(open.answer);
  if (!drive || !open.answer.good) told_(open.command, open.answer);
  if (drive && newest_) {
    const CommandMessage next = *std::exchange(newest_, std::nullopt);
    post(next);
  }
}

}  // namespace rave::gui_server
