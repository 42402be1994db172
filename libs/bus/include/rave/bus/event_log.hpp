// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "rave/base/log.hpp"
#include "rave/base/token_bucket.hpp"
#include "rave/bus/event.hpp"

namespace rave::bus {

/// Logs events that other processes cause, at a limited rate so that they cannot fill the log:
/// kAtOnce lines, then one per second. Repeated equal events of a process are dropped. Text is made
/// printable and cut at kMostBytes. The next line after dropped ones gives their number. One owner
/// thread.
class EventLog {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kAtOnce = 20;
  static constexpr std::size_t kMostBytes = 500;

  /// `log` is not owned; if null, nothing is written.
  explicit EventLog(LogSink* log) noexcept : log_(log) {}

  /// Logs problems: refused samples, incompatible QoS, other runs, warnings of Cyclone DDS. Other
  /// kinds of events are ignored.
  void note(const BusEvent& event, Clock::time_point now = Clock::now());
  /// Logs any other text that another process caused or wrote.
  void write(LogLevel level, std::string_view source, std::string_view text,
             Clock::time_point now = Clock::now());

 private:
  LogSink* log_;
  /// Refills by a line a second: other processes must not be able to fill the log.
  TokenBucket budget_{1, double{kAtOnce}};
  std::uint64_t left_out_ = 0;
  std::map<std::uint64_t, std::string> told_;  ///< By writer: the last event logged.
};

}  // namespace rave::bus
