// SPDX-License-Identifier: Apache-2.0
#include "answering.hpp"

namespace rave::control {
namespace {

/// Pause, resume, step and pace, which a live run refuses.
Answer hold(runtime::RunControl& control, const Request& request) {
  if (const auto idle = control.idle(); !idle.empty()) return {false, std::string(idle), {}};
  const runtime::RunStatus status = control.status();
  if (status.follows) {
    return {false, "this host follows its environment manager: send the request there", {}};
  }
  if (status.live) return {false, "a live run cannot be paused: the real world continues", {}};
  if (const auto* const pace = request.as<Pace>()) {
    control.set_pace(pace->factor);
    return {true, pace->factor == 0 ? "no limit" : fmt::format("{}x", pace->factor), {}};
  }
  const std::string waits =
      status.waits_for.empty() ? "" : fmt::format("; the run waits for {}", status.waits_for);
  if (request.as<Pause>() != nullptr) {
    control.pause();
    return {true, "paused" + waits, {}};
  }
  if (request.as<Resume>() != nullptr) {
    control.resume();
    return {true, "resumed" + waits, {}};
  }
  if (!status.paused) return {false, "the run is not paused", {}};
  const auto* const step = request.as<Step>();
  const std::uint64_t count = step != nullptr ? step->count : 0;
  control.step(count);
  const std::string steps = fmt::format("{} step{}", count, count == 1 ? "" : "s");
  if (waits.empty()) return {true, steps, {}};
  return {true, fmt::format("{} requested{}, which is late or lost", steps, waits), {}};
}

}  // namespace

std::optional<Answer> answer_at_once(runtime::RunControl& control, const Request& request) {
  if (request.relay && control.status().follows) {
    return Answer{false, "only requests over the bus are forwarded: address the manager", {}};
  }
  if (!request.own) return std::nullopt;
  if (request.as<AskStatus>() != nullptr) return Answer{true, "", control.status()};
  if (request.as<End>() == nullptr) return hold(control, request);
  control.end_run();
  return Answer{true, "ends", {}};
}

Answer answer_of(const Result<std::string>& result) {
  if (result) return {true, *result, {}};
  return {false, result.error().message, {}};
}

}  // namespace rave::control
