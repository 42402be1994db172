// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "rave/base/log.hpp"
#include "rave/bus/event.hpp"

namespace rave::bus {

/// Writes what other processes have caused to a log, which they cannot fill with it: kAtOnce lines,
/// then one a second; of each process not the same event twice in a row; printable text of at most
/// kMostBytes. The next line after those that were left out says how many. One owner thread.
class EventLog {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::size_t kAtOnce = 20;
  static constexpr std::size_t kMostBytes = 500;

  /// `log` is not owned; null: nothing is written.
  explicit EventLog(LogSink* log) noexcept : log_(log) {}

  /// What is wrong: refusals, ends that do not match, other runs, warnings of Cyclone DDS. Other
  /// events are nothing to write about.
  void note(const BusEvent& event, Clock::time_point now = Clock::now());
  /// Anything else that another process has caused, or that has its words.
  void write(LogLevel level, std::string_view source, std::string_view text,
             Clock::time_point now = Clock::now());

 private:
  [[nodiscard]] bool may_write(Clock::time_point now);

  LogSink* log_;
  std::size_t budget_ = kAtOnce;
  Clock::time_point refilled_{};
  std::uint64_t left_out_ = 0;
  std::map<std::uint64_t, std::string> told_;  ///< By writer: the last event.
};

}  // namespace rave::bus
