// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"

// The protocol of the control socket: one JSON object per line and direction. See
// docs/reference/control-socket.md.
namespace rave::control {

inline constexpr std::size_t kMaxLineBytes = 65'536;
inline constexpr std::size_t kMaxAnswerBytes = 16U << 20U;

// What a process answers at once, by itself; everything else is asked of the run.

struct AskStatus {
  static constexpr std::string_view kName = "status";
  friend bool operator==(const AskStatus&, const AskStatus&) = default;
};
struct Pause {
  static constexpr std::string_view kName = "pause";
  friend bool operator==(const Pause&, const Pause&) = default;
};
struct Resume {
  static constexpr std::string_view kName = "resume";
  friend bool operator==(const Resume&, const Resume&) = default;
};
/// Computes steps of a paused run.
struct Step {
  static constexpr std::string_view kName = "step";
  std::uint64_t count = 1;  ///< 1 to 1e9.
  friend bool operator==(const Step&, const Step&) = default;
};
/// Changes the pace of a run in lock-step.
struct Pace {
  static constexpr std::string_view kName = "pace";
  double factor = 1;  ///< Simulated seconds per second, up to 1e6; 0: no limit.
  friend bool operator==(const Pace&, const Pace&) = default;
};
struct End {
  static constexpr std::string_view kName = "end";
  friend bool operator==(const End&, const End&) = default;
};
using ProcessAction = std::variant<AskStatus, Pause, Resume, Step, Pace, End>;

/// One request to a process of a run.
struct Request {
  /// Empty: `run` is a request to the run; otherwise only its sender is set.
  std::optional<ProcessAction> own = AskStatus{};
  request::Request run{};
  /// Over the bus: a host forwards it to the Environment Manager and returns its answer.
  bool relay = false;

  template <class One>
  [[nodiscard]] const One* as() const noexcept {
    return own ? std::get_if<One>(&*own) : nullptr;
  }
  /// Whether it changes nothing: it has no author and is not logged.
  [[nodiscard]] bool only_reads() const noexcept {
    return own ? std::holds_alternative<AskStatus>(*own) : request::only_reads(run.action);
  }
  friend bool operator==(const Request&, const Request&) = default;
};

/// A request to the run itself.
[[nodiscard]] inline Request request_of(request::Request run) {
  return {std::nullopt, std::move(run), false};
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
  runtime::RunStatus status;  ///< With a scenario if it was asked for.
};

/// Parses a line. Its texts have no control characters but line ends. Error: kParse.
[[nodiscard]] Result<Answer> parse_answer(std::string_view line);
[[nodiscard]] std::string write_answer(const Answer& answer);

}  // namespace rave::control
