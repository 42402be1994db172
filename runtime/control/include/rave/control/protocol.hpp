// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"

// The protocol of the control socket: one JSON object per line and direction. See
// docs/reference/control-socket.md.
namespace rave::control {

inline constexpr std::size_t kMaxLineBytes = 65'536;
inline constexpr std::size_t kMaxAnswerBytes = 16U << 20U;

/// One request to a process of a run.
struct Request {
  /// All but kRun are answered at once, by the process alone.
  enum class What : std::uint8_t { kStatus, kPause, kResume, kStep, kEnd, kRun };
  What what = What::kStatus;
  std::uint64_t count = 1;  ///< kStep: 1 to 1e9.
  /// kRun: the request to the run, with finite numbers. Otherwise only its sender is set.
  runtime::RunRequest run = {};
  /// kRun, over the bus: a host forwards it to the Environment Manager and returns its answer.
  bool relay = false;

  /// Whether it changes nothing: it has no author and is not logged.
  [[nodiscard]] bool only_reads() const noexcept {
    return what == What::kStatus || (what == What::kRun && run.only_reads());
  }
  friend bool operator==(const Request&, const Request&) = default;
};

/// A request to the run itself.
[[nodiscard]] inline Request request_of(runtime::RunRequest run) {
  return {Request::What::kRun, 1, std::move(run), false};
}

/// The error for a line of more than kMaxLineBytes.
[[nodiscard]] std::string too_long_text();

/// Parses a line without its newline. Strict: an object with `rave: 1`, a known `do`, and the keys
/// that belong to it, each once and of its type. Errors: kParse, kInvalidArgument.
[[nodiscard]] Result<Request> parse_request(std::string_view line);
/// The line with its newline; parse_request() gives an equal value.
[[nodiscard]] std::string write_request(const Request& request);

/// The answer of a run.
struct Answer {
  bool good = false;
  std::string text;           ///< The result, or the error.
  runtime::RunStatus status;  ///< With a scenario if the request was kStatus.
};

/// Parses a line. Its texts have no control characters but line ends. Error: kParse.
[[nodiscard]] Result<Answer> parse_answer(std::string_view line);
[[nodiscard]] std::string write_answer(const Answer& answer);

}  // namespace rave::control
