// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"

namespace rave::bus {

/// The four times of a request and its reply, in nanoseconds, each of the clock that it was read
/// from. Both clocks must be monotonic: a clock that is set during a run makes the result wrong.
struct ClockExchange {
  std::int64_t asked_ns = 0;     ///< Local clock: the request was sent.
  std::int64_t received_ns = 0;  ///< Remote clock: the request was received.
  std::int64_t answered_ns = 0;  ///< Remote clock: the reply was sent.
  std::int64_t heard_ns = 0;     ///< Local clock: the reply was received.
};

/// The offset of a remote clock: remote = local + offset, with an error of at most `bound`.
struct ClockReading {
  Duration offset;
  Duration bound;
};

/// The offset from one exchange, by the method of NTP (RFC 5905, section 8). The offset assumes
/// equal delays in both directions; the bound is half of the round-trip time without processing.
/// Error kInvalidArgument: a reply is earlier than its request.
[[nodiscard]] Result<ClockReading> read_clock(const ClockExchange& exchange);

/// Tracks a remote clock by repeated exchanges. Of those within the window it uses the one with the
/// least bound, where each bound grows with age by the possible drift. One owner thread.
class ClockOffset {
 public:
  struct Options {
    Duration window{10'000'000'000};
    double max_drift = 100e-6;  ///< Largest relative drift of the two clocks (s/s).
  };

  explicit ClockOffset(Options options) : options_(options) {}
  ClockOffset() : ClockOffset(Options()) {}

  /// Adds an exchange. Error: that of read_clock(); the exchange is then dropped.
  [[nodiscard]] Status add(const ClockExchange& exchange);
  /// The offset at local time `now_ns`; empty if the window has no exchange.
  [[nodiscard]] std::optional<ClockReading> at(std::int64_t now_ns) const;

 private:
  struct Entry {
    std::int64_t heard_ns;
    ClockReading reading;
  };
  [[nodiscard]] Duration bound_at(const Entry& entry, std::int64_t now_ns) const;

  Options options_;
  std::deque<Entry> entries_;
};

}  // namespace rave::bus
