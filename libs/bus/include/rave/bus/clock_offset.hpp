// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"

namespace rave::bus {

/// The four times of one question and answer, each in nanoseconds of the clock that it was read
/// from. No clock may be set while a run lasts, so they are monotonic ones.
struct ClockExchange {
  std::int64_t asked_ns = 0;     ///< Ours, when the question left.
  std::int64_t received_ns = 0;  ///< Theirs.
  std::int64_t answered_ns = 0;  ///< Theirs.
  std::int64_t heard_ns = 0;     ///< Ours, when the answer was there.
};

/// Where another clock stands: theirs = ours + offset, give or take the bound.
struct ClockReading {
  Duration offset;
  Duration bound;
};

/// What one exchange says, by the method of NTP (RFC 5905, section 8): the offset if both ways took
/// equally long, and half of the time on the way as its bound. Error kInvalidArgument if an answer
/// comes before its question.
[[nodiscard]] Result<ClockReading> read_clock(const ClockExchange& exchange);

/// Follows another clock by repeated exchanges: of those in a window it uses the one whose bound,
/// grown by what the clocks may have drifted since, is least. One owner thread.
class ClockOffset {
 public:
  struct Options {
    Duration window{10'000'000'000};
    double max_drift = 100e-6;  ///< Seconds per second by which two clocks may part.
  };

  explicit ClockOffset(Options options) : options_(options) {}
  ClockOffset() : ClockOffset(Options()) {}

  /// Error as of read_clock(); the exchange is then dropped.
  [[nodiscard]] Status add(const ClockExchange& exchange);
  /// At `now_ns` of our clock; nothing while there is no exchange in the window.
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
