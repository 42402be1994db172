// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"

// What is said over the socket of a run: one JSON object in a line each way. See
// docs/reference/control-socket.md.
namespace rave::control {

inline constexpr std::size_t kMaxLineBytes = 65'536;
inline constexpr std::size_t kMaxAnswerBytes = 16U << 20U;

/// One question to a run.
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
  std::string robot;        ///< kStop, kRelease, kArm, kResetShadow: empty: all; kSet, kHandOver.
  std::string key;          ///< kSet; kRemove: the name of an obstacle.
  std::string value;        ///< kSet; kHandOver; kAdd and kMove: YAML, see runtime::RunRequest.
  std::uint64_t count = 1;  ///< kStep: 1 to 1e9.
  // Orders and leases, see runtime::RunRequest. All finite.
  std::string by = {};     ///< Also of what changes something: who asks.
  bool overrides = false;  ///< The same: a super-user asks.
  std::uint64_t page = 0;  ///< The same: on which of their pages; 0: on none.
  std::vector<Vec2> points = {};
  std::optional<double> yaw_rad = std::nullopt;
  double v_mps = 0;
  double w_radps = 0;
  double speed_mps = 0;
  friend bool operator==(const Request&, const Request&) = default;
};

/// A request to a run, as it is said; not kStatus and what holds a run.
[[nodiscard]] Request request_of(const runtime::RunRequest& request);
/// The same back.
[[nodiscard]] runtime::RunRequest run_request(const Request& request);

/// Why a line of more than kMaxLineBytes is not read.
[[nodiscard]] std::string too_long_text();

/// Reads a line without its end. Strict: an object with `rave: 1`, a `do` that is known and the
/// keys that go with it, each of its type and once. Errors: kParse, kInvalidArgument.
[[nodiscard]] Result<Request> parse_request(std::string_view line);
/// The line, with its end, that parse_request reads back as an equal value.
[[nodiscard]] std::string write_request(const Request& request);

/// What a run answers.
struct Answer {
  bool good = false;
  std::string text;           ///< What was done, or what is wrong.
  runtime::RunStatus status;  ///< With a scenario if the request was kStatus.
};

[[nodiscard]] Result<Answer> parse_answer(std::string_view line);
[[nodiscard]] std::string write_answer(const Answer& answer);

}  // namespace rave::control
