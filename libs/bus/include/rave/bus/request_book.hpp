// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/token_bucket.hpp"

namespace rave::bus {

/// A request that was begun.
struct BegunRequest {
  /// Polled until it returns the answer: one line of UTF-8 without a newline. It must not block.
  std::function<std::optional<std::string>()> answer;
  std::string told;  ///< The text for the log; empty if the request changes nothing.
  /// False: the line was not a valid request. Logged at most once a second per process.
  bool understood = true;
};

/// Begins the request of a line without waiting for it. Always called in the same thread.
using BeginRequest = std::function<BegunRequest(std::string_view line)>;

/// The requests that a process has received. It limits the rate and the number of each sender, so
/// none keeps the others waiting, and executes a repeated request once. One owner thread.
class RequestBook {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kPerSecond = 10;          ///< Rate limit of one writer.
  static constexpr double kAtOnce = 20;             ///< Burst limit of one writer.
  static constexpr double kAllPerSecond = 50;       ///< Rate limit of all writers together.
  static constexpr double kAllAtOnce = 100;         ///< Burst limit of all writers together.
  static constexpr std::size_t kMostOpenEach = 4;   ///< Unanswered requests of one writer.
  static constexpr std::size_t kMostOpen = 32;      ///< Unanswered requests of all writers.
  static constexpr std::size_t kMostAskers = 256;   ///< Writers that are remembered.
  static constexpr std::chrono::seconds kKept{10};  ///< How long an answer can be repeated.
  /// Total size in bytes of the answers that are longer than a message and are kept to be fetched.
  static constexpr std::size_t kMostKeptLong = std::size_t{16} << 20U;

  /// A received request. `writer` and `number` are above 0.
  struct Heard {
    std::uint64_t writer = 0;  ///< The sender.
    std::uint64_t number = 0;  ///< Number of the request; a repetition has the same number.
    std::string_view from;     ///< Name of the sender, for the log.
    std::string_view line;
  };
  /// An answer to send.
  struct Reply {
    std::uint64_t target = 0;  ///< The writer that sent the request.
    std::uint64_t number = 0;
    bool taken = false;  ///< False: the request was refused here; `text` gives the reason.
    std::string text;    ///< The answer; of a long one the requested part, see request_parts.hpp.
  };

  /// `log` is not owned and may be null.
  RequestBook(BeginRequest begin, LogSink* log) : begin_(std::move(begin)), log_(log) {}

  /// Begins a request, unless it exceeds a limit or is a repetition.
  void hear(const Heard& request, Clock::time_point now);
  /// The answers that became available since the last call.
  [[nodiscard]] std::vector<Reply> take(Clock::time_point now);
  /// The number of unanswered requests.
  [[nodiscard]] std::size_t open() const noexcept { return open_.size(); }
  /// Whether take() has nothing to do until the next request: as of the last take(), none is
  /// unanswered and no answer is kept.
  [[nodiscard]] bool idle() const noexcept { return open_.empty() && kept_ == 0; }

 private:
  struct Asker {
    TokenBucket budget{kPerSecond, kAtOnce};
    std::uint64_t last = 0;  ///< The highest number that was accepted or refused.
    std::size_t open = 0;
    Clock::time_point heard{};
    std::optional<Clock::time_point> scolded{};  ///< When it was last told that it exceeds a limit.
    std::optional<Clock::time_point> babbled{};  ///< When an invalid request of it was last logged.
    std::optional<Reply> said{};                 ///< The last answer.
    Clock::time_point said_at{};
  };
  struct Open {
    std::uint64_t writer = 0;
    std::uint64_t number = 0;
    BegunRequest begun;
  };

  [[nodiscard]] Asker* asker_of(std::uint64_t writer, Clock::time_point now);
  void refuse(const Heard& request, Asker& asker, std::string_view why, Clock::time_point now);
  [[nodiscard]] std::size_t kept_long(const Asker* but) const;
  void reply(Asker* asker, Reply reply, Clock::time_point now);
  void send(Reply reply, std::size_t from);

  BeginRequest begin_;
  LogSink* log_;
  TokenBucket all_{kAllPerSecond, kAllAtOnce};
  std::map<std::uint64_t, Asker> askers_;  ///< By writer.
  std::vector<Open> open_;                 ///< In the order of arrival.
  std::vector<Reply> replies_;
  std::size_t kept_ = 0;  ///< The number of answers kept for repetition, as of the last take().
};

}  // namespace rave::bus
