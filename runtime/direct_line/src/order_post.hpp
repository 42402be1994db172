// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rave/control/run_control.hpp"

namespace rave::direct_line {

/// Gives orders of lines to a run and fetches its answers, without ever waiting for it. Of drives
/// that the run has not come to, the newest of each robot counts. One thread.
class OrderPost {
 public:
  using Line = std::uint64_t;
  using Answer = std::function<void(bool good, const std::string& text)>;

  /// Of one line, and not answered; more are refused. Stops are never refused.
  static constexpr std::size_t kMostWaiting = 256;

  /// `control` outlives it.
  explicit OrderPost(runtime::RunControl& control) : control_(control) {}

  /// One order to one or several robots, with one answer.
  void give(Line line, std::vector<runtime::RunRequest> requests, Answer answer);
  /// The newest drive of a robot. Refusals are answered; with `echo` each drive is, one that a
  /// newer drive replaced before the run took it as accepted.
  void drive(Line line, runtime::RunRequest request, bool echo, Answer answer);
  /// A line is gone: what it drives stands, and its answers are for nobody.
  void forget(Line line);
  /// Hands out the answers that have come.
  void poll();
  [[nodiscard]] std::uint64_t given() const noexcept { return given_; }

 private:
  using Future = std::future<Result<std::string>>;
  struct Waiting {
    Line line = 0;
    std::vector<Future> futures;
    Answer answer;
    std::string done{};
    std::string refused{};
  };
  struct Drive {
    std::optional<Future> under_way{};
    bool echo = false;  ///< Of the one under way.
    Answer answer{};    ///< The same.
    bool moves = false;
    std::chrono::steady_clock::time_point since{};  ///< Of `newest`.
    runtime::RunRequest newest{};
    std::optional<std::pair<bool, Answer>> next{};  ///< `newest` is not given yet.
  };
  void begin(Drive& drive, bool echo, Answer answer);
  void poll(Drive& drive);
  [[nodiscard]] static bool take_answers(Waiting& waiting);

  runtime::RunControl& control_;
  std::vector<Waiting> waiting_;
  std::map<std::pair<Line, std::string>, Drive> drives_;
  std::uint64_t given_ = 0;
};

}  // namespace rave::direct_line
