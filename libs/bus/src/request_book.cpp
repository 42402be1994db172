// SPDX-License-Identifier: Apache-2.0
// Requests of other processes, answered once each. Budgets per sender and for all bound what a
// faulty one costs.
#include "rave/bus/request_book.hpp"

#include <algorithm>
#include <utility>

#include "rave/base/control_characters.hpp"
#include "rave/bus/request_parts.hpp"
#include "rave/bus/topics.hpp"

namespace rave::bus {
namespace {

/// Minimum interval of refusals to the same sender.
constexpr std::chrono::seconds kScolding{1};
/// Longest line in the log.
constexpr std::size_t kMostTold = 300;

std::string for_log(std::string text) {
  if (text.size() > kMostTold) text = text.substr(0, kMostTold) + "...";
  return without_control_characters(text, " ");
}

bool is_long(const RequestBook::Reply& reply) {
  return reply.text.size() > rave_wire_kMaxRequestAnswerBytes;
}

}  // namespace

/// Null: no room for another sender.
RequestBook::Asker* RequestBook::asker_of(std::uint64_t writer, Clock::time_point now) {
  auto place = askers_.find(writer);
  if (place == askers_.end()) {
    if (askers_.size() >= kMostAskers) {
      auto oldest = askers_.end();
      for (auto i = askers_.begin(); i != askers_.end(); ++i) {
        if (i->second.open > 0) continue;
        if (oldest == askers_.end() || i->second.heard < oldest->second.heard) oldest = i;
      }
      // impossible while kMostOpen is below kMostAskers
      if (oldest == askers_.end()) return nullptr;
      askers_.erase(oldest);
    }
    place = askers_.try_emplace(writer).first;
  }
  place->second.heard = now;
  return &place->second;
}

/// Total size of long answers kept for senders other than this one.
std::size_t RequestBook::kept_long(const Asker* but) const {
  std::size_t bytes = 0;
  for (const auto& [writer, asker] : askers_) {
    if (&asker != but && asker.said && is_long(*asker.said)) bytes += asker.said->text.size();
  }
  return bytes;
}

void RequestBook::reply(Asker* asker, Reply reply, Clock::time_point now) {
  if (is_long(reply)) {
    const std::size_t bytes = reply.text.size();
    if (bytes > kMostAnswerBytes) {
      reply.taken = false;
      reply.text = fmt::format(
          "it was carried out, but the answer has {} bytes, and the bus carries {}: send the "
          "request on the machine of this process",
          bytes, kMostAnswerBytes);
    } else if (asker == nullptr || kept_long(asker) + bytes > kMostKeptLong) {
      reply.taken = false;
      reply.text = fmt::format(
          "it was carried out, but the answer has {} bytes and too many long answers are pending; "
          "try again later",
          bytes);
    }
  }
  if (asker != nullptr) {
    // Kept for a while: an asker that missed the answer repeats its request, which must not be
    // carried out twice.
    asker->said = reply;
    asker->said_at = now;
  }
  send(std::move(reply), 0);
}

/// Sends the part of an answer that fits into one message.
void RequestBook::send(Reply reply, std::size_t from) {
  auto part = answer_part(reply.text, from);
  if (!part) return;
  reply.text = *std::move(part);
  replies_.push_back(std::move(reply));
}

void RequestBook::refuse(const Heard& request, Asker& asker, std::string_view why,
                         Clock::time_point now) {
  // A sender without an answer repeats the request later, when there may be room.
  if (asker.scolded && now - *asker.scolded < kScolding) return;
  asker.scolded = now;
  asker.last = request.number;
  if (log_ != nullptr) log_->warn("by hand", "refused of `{}` over the bus: {}", request.from, why);
  reply(&asker, {request.writer, request.number, false, std::string(why)}, now);
}

void RequestBook::hear(const Heard& request, Clock::time_point now) {
  const auto [writer, number, from, line] = request;
  // A known sender uses its own budget. New senders share one, so that invented ids are stopped
  // before anything is stored about them.
  const bool known = askers_.contains(writer);
  if (!known && !all_.take(now)) return;
  Asker* const asker = asker_of(writer, now);
  if (asker == nullptr) return;
  const bool in_time = asker->budget.take(now) && (!known || all_.take(now));
  // A repetition, or an old request that arrives late.
  if (number <= asker->last) {
    if (in_time && asker->said && asker->said->number == number) {
      send(*asker->said, rest_requested(line));
    }
    return;
  }
  if (!in_time) {
    refuse(request, *asker, "too many requests; try again later", now);
    return;
  }
  if (asker->open >= kMostOpenEach || open_.size() >= kMostOpen) {
    refuse(request, *asker, "too many requests are waiting; try again later", now);
    return;
  }
  asker->last = number;
  BegunRequest begun = begin_(line);
  const bool again = !begun.understood && asker->babbled && now - *asker->babbled < kScolding;
  if (!begun.understood && !again) asker->babbled = now;
  if (log_ != nullptr && !begun.told.empty() && !again) {
    log_->info("by hand", "from `{}` over the bus: {}", from, for_log(begun.told));
  }
  ++asker->open;
  open_.push_back({writer, number, std::move(begun)});
}

std::vector<RequestBook::Reply> RequestBook::take(Clock::time_point now) {
  std::erase_if(open_, [&](Open& one) {
    auto text = one.begun.answer();
    if (!text) return false;
    const auto place = askers_.find(one.writer);
    Asker* const asker = place == askers_.end() ? nullptr : &place->second;
    if (asker != nullptr && asker->open > 0) --asker->open;
    reply(asker, {one.writer, one.number, true, *std::move(text)}, now);
    return true;
  });
  kept_ = 0;
  for (auto& [writer, asker] : askers_) {
    if (asker.said && now - asker.said_at > kKept) asker.said.reset();
    if (asker.said) ++kept_;
  }
  return std::exchange(replies_, {});
}

}  // namespace rave::bus
