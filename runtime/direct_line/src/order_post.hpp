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

/// Passes orders from lines to a run and fetches the answers, without waiting for the run. Of the
/// drive commands that the run has not taken yet, only the newest of each robot counts. Used by one
/// thread.
class OrderPost {
 public:
  using Line = std::uint64_t;
  using Answer = std::function<void(bool good, const std::string& text)>;

  /// Unanswered orders per line; further ones are refused, except stops.
  static constexpr std::size_t kMostWaiting = 256;

  /// `control` must outlive this object.
  explicit OrderPost(runtime::RunControl& control) : control_(control) {}

  /// Passes on one order to one or several robots, with one common answer.
  void give(Line line, std::vector<request::Request> requests, Answer answer);
  /// Passes on the newest drive command of a robot. Refusals are answered; with `echo` each command
  /// is, and one that a newer command replaced before the run took it counts as accepted.
  void drive(Line line, request::Request request, bool echo, Answer answer);
  /// Called when a line has closed: stops the robots that it drives and drops its answers.
  void forget(Line line);
  /// Passes on the answers that have arrived.
  void poll();

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
    bool echo = false;  ///< The `echo` of the command that the run is handling.
    Answer answer{};    ///< The answer function of that command.
    bool moves = false;
    std::chrono::steady_clock::time_point since{};  ///< Of `newest`.
    request::Request newest{};
    std::optional<std::pair<bool, Answer>> next{};  ///< Of `newest`, until that is passed on.
  };
  void begin(Drive& drive, bool echo, Answer answer);
  void poll(Drive& drive);
  [[nodiscard]] static bool take_answers(Waiting& waiting);

  runtime::RunControl& control_;
  std::vector<Waiting> waiting_;
  std::map<std::pair<Line, std::string>, Drive> drives_;
};

}  // namespace rave::direct_line
