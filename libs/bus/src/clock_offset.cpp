// SPDX-License-Identifier: Apache-2.0
// The difference between two clocks from exchanges of four stamps, with a bound of its error. The
// best exchange of a window counts.
#include "rave/bus/clock_offset.hpp"

#include <cmath>

namespace rave::bus {

Result<ClockReading> read_clock(const ClockExchange& exchange) {
  // Clocks of different machines differ arbitrarily, so differences are formed within one clock
  // only.
  const std::int64_t away = exchange.heard_ns - exchange.asked_ns;
  const std::int64_t held = exchange.answered_ns - exchange.received_ns;
  if (away < 0 || held < 0 || held > away) {
    return fail(ErrorCode::kInvalidArgument,
                "impossible clock exchange of {} ns, of which {} ns at the other end", away, held);
  }
  // As NTP: the offset is exact if both ways took equally long, and wrong by at most half of the
  // time on the way if not (RFC 5905, section 8).
  const std::int64_t on_the_way = away - held;
  // Halving an odd sum truncates half a nanosecond; rounding the bound up covers it.
  const std::int64_t there = exchange.received_ns - exchange.asked_ns;
  return ClockReading{{there - on_the_way / 2}, {on_the_way / 2 + 1}};
}

Status ClockOffset::add(const ClockExchange& exchange) {
  RAVE_TRY_ASSIGN(const ClockReading reading, read_clock(exchange));
  entries_.push_back({exchange.heard_ns, reading});
  while (entries_.front().heard_ns < exchange.heard_ns - options_.window.ns) entries_.pop_front();
  // A newer exchange with no larger bound stays better as long as both are in the window.
  // What remains has ascending bounds, as in a monotone queue.
  while (entries_.size() > 1) {
    const Entry& older = entries_[entries_.size() - 2];
    if (bound_at(older, exchange.heard_ns) < reading.bound) break;
    entries_.erase(entries_.end() - 2);
  }
  return {};
}

std::optional<ClockReading> ClockOffset::at(std::int64_t now_ns) const {
  std::optional<ClockReading> best;
  for (const Entry& entry : entries_) {
    if (entry.heard_ns < now_ns - options_.window.ns) continue;
    const Duration bound = bound_at(entry, now_ns);
    if (!best || bound < best->bound) best = ClockReading{entry.reading.offset, bound};
  }
  return best;
}

// Clocks drift apart, so an old exchange is worth less and less.
Duration ClockOffset::bound_at(const Entry& entry, std::int64_t now_ns) const {
  const auto age_ns = static_cast<double>(now_ns - entry.heard_ns);
  const double drift_ns = std::ceil(std::fabs(age_ns) * options_.max_drift);
  return {entry.reading.bound.ns + static_cast<std::int64_t>(drift_ns)};
}

}  // namespace rave::bus
