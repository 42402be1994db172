// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"

// The protocol of the control socket: one JSON object per line and direction. See
// docs/reference/control-socket.md.
namespace rave::control {

inline constexpr std::size_t kMaxLineBytes = 65'536;
inline constexpr std::size_t kMaxAnswerBytes = 16U << 20U;

/// One request to a run.
struct Request {
  enum class What : std::uint8_t {
    kStatus,
    kStop,
    kRelease,
    kArm,
    kSet,
    kPause,
    kResume,
    kStep,
    kEnd,
    kAdd,
    kMove,
    kRemove,
    kList,
    kHandOver,
    kResetShadow,
    kDrive,
    kGoal,
    kPath,
    kCancel,
    kText,
    kPlace,
    kTake,
    kGive,
    kChat,
  };
  What what = What::kStatus;
  std::string robot;  ///< kStop, kRelease, kArm, kResetShadow: empty: all robots; kSet, kHandOver.
  std::string key;    ///< kSet; kRemove: the name of an obstacle.
  std::string value;  ///< kSet; kHandOver; kAdd and kMove: YAML, see runtime::RunRequest.
  std::uint64_t count = 1;  ///< kStep: 1 to 1e9.
  // Orders and leases, see runtime::RunRequest. All numbers are finite.
  std::string by = {};     ///< The sender; also for requests that change something.
  bool overrides = false;  ///< Whether the sender is a super-user.
  std::uint64_t page = 0;  ///< The sender's page; 0: none.
  std::vector<Vec2> points = {};
  std::optional<double> yaw_rad = std::nullopt;
  double v_mps = 0;
  double w_radps = 0;
  double speed_mps = 0;
  friend bool operator==(const Request&, const Request&) = default;
};

/// A run request in the form of the protocol; not for kStatus and requests that pause or end a run.
[[nodiscard]] Request request_of(const runtime::RunRequest& request);
/// The inverse of request_of().
[[nodiscard]] runtime::RunRequest run_request(const Request& request);

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

[[nodiscard]] Result<Answer> parse_answer(std::string_view line);
[[nodiscard]] std::string write_answer(const Answer& answer);

}  // namespace rave::control
