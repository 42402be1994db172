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

namespace rave::bus {

/// What was begun of a wish.
struct BegunWish {
  /// Called now and then until it gives the answer, a line of UTF-8 without its end; never waits.
  std::function<std::optional<std::string>()> answer;
  std::string told;        ///< What the log says was asked; empty: it only looks.
  bool understood = true;  ///< False: nothing was begun; the log says so once a second of each.
};

/// Begins what a line asks, without waiting for it. Whoever calls it does so in one thread.
using BeginWish = std::function<BegunWish(std::string_view line)>;

/// The wishes that one process was asked: who asks too often or too much at once is refused, and
/// nobody keeps the others from being heard. What comes twice is done once. One owner thread.
class WishBook {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr double kPerSecond = 10;          ///< Of one writer.
  static constexpr double kAtOnce = 20;             ///< Of one that was quiet.
  static constexpr double kAllPerSecond = 50;       ///< Of all writers together.
  static constexpr double kAllAtOnce = 100;         ///< The same.
  static constexpr std::size_t kMostOpenEach = 4;   ///< That wait for their answer, of one writer.
  static constexpr std::size_t kMostOpen = 32;      ///< Of all.
  static constexpr std::size_t kMostAskers = 256;   ///< That are remembered.
  static constexpr std::chrono::seconds kKept{10};  ///< So long an answer can be given again.
  /// Bytes of all answers together that are longer than a message and so are kept to be fetched.
  static constexpr std::size_t kMostKeptLong = std::size_t{16} << 20U;

  /// A wish that has come. `writer` and `number` are above 0.
  struct Heard {
    std::uint64_t writer = 0;  ///< Who asks.
    std::uint64_t number = 0;  ///< The same again: it was sent again.
    std::string_view from;     ///< Who asks, for the log.
    std::string_view line;
  };
  /// What is to be sent.
  struct Reply {
    std::uint64_t target = 0;  ///< The writer that asked.
    std::uint64_t number = 0;
    bool taken = false;  ///< False: refused here, and `text` says why.
    std::string text;    ///< Of a long answer the part that was asked for; see wish_parts.hpp.
  };

  /// `log` is not owned and may be null.
  WishBook(BeginWish begin, LogSink* log) : begin_(std::move(begin)), log_(log) {}

  /// Begins it, unless it is too much or was begun before.
  void hear(const Heard& wish, Clock::time_point now);
  /// The answers that there are since the last call.
  [[nodiscard]] std::vector<Reply> take(Clock::time_point now);
  /// How many wait for their answer.
  [[nodiscard]] std::size_t open() const noexcept { return open_.size(); }
  /// Whether take() has nothing to do until the next wish: as of the last take(), none waits for
  /// its answer and no answer is kept.
  [[nodiscard]] bool idle() const noexcept { return open_.empty() && kept_ == 0; }

 private:
  /// What may be taken now, filled again as time goes by.
  struct Budget {
    double left = 0;
    Clock::time_point filled{};
    [[nodiscard]] bool take(double per_second, double most, Clock::time_point now);
  };
  struct Asker {
    Budget budget{};
    std::uint64_t last = 0;  ///< The highest number that was taken or refused.
    std::size_t open = 0;
    Clock::time_point heard{};
    std::optional<Clock::time_point> scolded{};  ///< When it was last told that it is too much.
    std::optional<Clock::time_point> babbled{};  ///< When its nonsense was logged last.
    std::optional<Reply> said{};                 ///< The last answer.
    Clock::time_point said_at{};
  };
  struct Open {
    std::uint64_t writer = 0;
    std::uint64_t number = 0;
    BegunWish begun;
  };

  [[nodiscard]] Asker* asker_of(std::uint64_t writer, Clock::time_point now);
  void refuse(const Heard& wish, Asker& asker, std::string_view why, Clock::time_point now);
  [[nodiscard]] std::size_t kept_long(const Asker* but) const;
  void reply(Asker* asker, Reply reply, Clock::time_point now);
  void send(Reply reply, std::size_t from);

  BeginWish begin_;
  LogSink* log_;
  Budget all_{};
  std::map<std::uint64_t, Asker> askers_;  ///< By writer.
  std::vector<Open> open_;                 ///< In the order in which they came.
  std::vector<Reply> replies_;
  std::size_t kept_ = 0;  ///< Answers that can be given again, as of the last take().
};

}  // namespace rave::bus
