// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/token_bucket.hpp"
#include "rave/bus/topics.hpp"

namespace rave::bus {

/// The result of a command: what was done, or why it was refused.
struct CommandResult {
  bool accepted = false;
  std::string text;  ///< A sentence of UTF-8 without control characters.
};

/// A command that was begun. Polled until it returns the result; it must not block. Empty: the
/// command gets no answer.
using BegunCommand = std::function<std::optional<CommandResult>()>;

/// Begins a command, without waiting for it. The sample has passed validate() and is valid during
/// the call only. Always called in the same thread.
using BeginCommand = std::function<BegunCommand(const Command&)>;

/// The commands that a process has received. It limits their rate except of stops, ignores commands
/// that are older than the newest of the same sender and robot, and executes a repeated command
/// once. One owner thread.
class CommandBook {
 public:
  using Clock = std::chrono::steady_clock;
  /// Commands per second, from all senders together; also the largest burst.
  static constexpr double kPerSecond = 5000;
  /// Pairs of sender and robot that are remembered.
  static constexpr std::size_t kMostKnown = 100'000;
  /// Orders that wait for their results.
  static constexpr std::size_t kMostOpen = 8192;
  /// Answers of one sender and robot that can be repeated.
  static constexpr std::size_t kMostKept = 8;

  /// An answer to send.
  struct Reply {
    std::uint64_t target = 0;  ///< The writer that sent the command.
    std::uint32_t robot = 0;
    std::uint64_t number = 0;  ///< That of the command.
    CommandResult result;
  };

  /// `log` is not owned and may be null.
  CommandBook(BeginCommand begin, LogSink* log) : begin_(std::move(begin)), log_(log) {}

  /// Begins a command, unless it exceeds the rate, is old, or is a repetition.
  void hear(const Command& command, Clock::time_point now);
  /// The answers that became available since the last call.
  [[nodiscard]] std::vector<Reply> take();
  /// Whether take() has nothing to do until the next command.
  [[nodiscard]] bool idle() const noexcept { return open_.empty() && replies_.empty(); }

 private:
  using Key = std::pair<std::uint64_t, std::uint32_t>;  ///< Sender and robot.
  struct Known {
    std::uint64_t newest = 0;
    std::size_t open = 0;      ///< Commands without a result.
    std::deque<Reply> kept{};  ///< The last answers, oldest first.
  };
  struct Open {
    Key key;
    std::uint64_t number = 0;
    BegunCommand begun;
  };

  void hear_again(const Command& command, const Known& known);
  void refuse(const Command& command, const char* why);

  BeginCommand begin_;
  LogSink* log_;
  TokenBucket budget_{kPerSecond, kPerSecond};
  std::optional<Clock::time_point> warned_{};  ///< When the log last told of too many commands.
  std::map<Key, Known> known_;
  std::vector<Open> open_;  ///< In the order of arrival.
  std::vector<Reply> replies_;
};

}  // namespace rave::bus
