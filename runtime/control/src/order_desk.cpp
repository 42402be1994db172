// SPDX-License-Identifier: Apache-2.0
#include "rave/control/order_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "rave/control/order_words.hpp"

namespace rave::runtime {
namespace {

RunRequest ended_by(RunRequest::Kind kind, const std::string& robot, const std::string& by) {
  RunRequest request;
  request.kind = kind;
  request.robot = robot;
  // The name of the terminal is used in messages only.
  if (by != HostLeases::kTerminal) request.by = by;
  return request;
}

HostLeases::Person person_of(const RunRequest& request) {
  return {request.by, request.overrides, request.page};
}

HeldSticks::Stick stick_of(const RunRequest& request) {
  return {request.robot, request.by, request.page};
}

bool stands(const RunRequest& drive) { return drive.v_mps == 0 && drive.w_radps == 0; }

bool is_of_lease(RunRequest::Kind kind) {
  return kind == RunRequest::Kind::kTake || kind == RunRequest::Kind::kGive;
}

}  // namespace

bool OrderDesk::is_for(RunRequest::Kind kind) noexcept {
  return is_order(kind) || kind == RunRequest::Kind::kTake || kind == RunRequest::Kind::kGive ||
         kind == RunRequest::Kind::kRelease || kind == RunRequest::Kind::kHandOver;
}

Status OrderDesk::check_rate(const std::string& robot, Time now) {
  Bucket& bucket = rates_[robot];
  if (bucket.since != Time()) {
    const double passed_s = std::chrono::duration<double>(now - bucket.since).count();
    bucket.left = std::min(kMostInSecond, bucket.left + passed_s * kMostInSecond);
  }
  bucket.since = now;
  if (bucket.left < 1) {
    return fail(ErrorCode::kState, "robot `{}`: more than {} orders in a second",
                robot.substr(0, robot.find('\n')), kMostInSecond);
  }
  bucket.left -= 1;
  return {};
}

Status OrderDesk::check_release(const RunRequest& request, Time now) {
  if (request.by.empty() || request.overrides) return {};
  if (!request.robot.empty()) {
    return leases_.use(request.robot, person_of(request), HostLeases::Use::kLook, now);
  }
  return fail(ErrorCode::kState,
              "only a super-user can release all robots; release those that you drive one by one");
}

Result<std::string> OrderDesk::serve(const RunRequest& request, const Give& give,
                                     const IsDriven& is_driven, Time now) {
  leases_.expire(now);
  follow_leases(give);
  const bool gives_to_it =
      request.kind == RunRequest::Kind::kGive && request.value == HostLeases::kTerminal;
  if (request.by == HostLeases::kTerminal || gives_to_it) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not a valid name of a person",
                HostLeases::kTerminal);
  }
  if (request.kind == RunRequest::Kind::kRelease) {
    RAVE_TRY(check_release(request, now));
    return give(request);
  }
  // The driver of a robot must not find a different robot in its place.
  if (request.kind == RunRequest::Kind::kHandOver && !request.robot.empty()) {
    RAVE_TRY(check_release(request, now));
    return give(request);
  }
  const bool for_all = request.kind == RunRequest::Kind::kCancel && request.robot.empty();
  if (request.robot.empty() && !for_all) {
    return fail(ErrorCode::kInvalidArgument, "`{}` needs a robot", to_string(request.kind));
  }
  if (for_all && !request.by.empty() && !request.overrides) {
    return fail(ErrorCode::kState, "only a super-user can cancel the orders of all robots");
  }
  const bool drives = request.kind == RunRequest::Kind::kDrive;
  if (drives && stands(request)) {
    RAVE_TRY_ASSIGN(const auto use, look_at_stick(request, is_driven, now));
    if (use == HeldSticks::Use::kFreed) return "the stick of " + request.robot + " is neutral";
  }
  // What others send to a robot that a person drives must not use up what its driver may send.
  if (!is_of_lease(request.kind) && !request.robot.empty()) {
    const Status own = leases_.use(request.robot, person_of(request), HostLeases::Use::kLook, now);
    if (!own) return refused(request, own.error(), now);
  }
  if (drives && !stands(request)) RAVE_TRY(look_at_stick(request, is_driven, now));
  RAVE_TRY(check_rate(is_of_lease(request.kind) ? request.robot + "\n" : request.robot, now));
  auto answer = carry_out(request, give, is_driven, now);
  follow_leases(give);
  if (!answer) return refused(request, answer.error(), now);
  return answer;
}

Result<HeldSticks::Use> OrderDesk::look_at_stick(const RunRequest& drive, const IsDriven& is_driven,
                                                 Time now) {
  const HeldSticks::Stick stick = stick_of(drive);
  // A stop ends a drive in the run; the stick may still be held when the robot is released.
  if (watch_.moves(drive.robot, drive.by, drive.page) && !is_driven(drive.robot)) {
    watch_.ended(drive.robot);
    sticks_.hold(stick, drive.robot + " was stopped while it was driven", now);
  }
  return sticks_.use(stick, stands(drive), now);
}

tl::unexpected<Error> OrderDesk::refused(const RunRequest& request, Error why, Time now) {
  // Another error is a mistake in the request, which the next one may not have.
  const bool held =
      request.kind == RunRequest::Kind::kDrive && !stands(request) && why.code == ErrorCode::kState;
  if (held) sticks_.hold(stick_of(request), why.message, now);
  return tl::unexpected(std::move(why));
}

Result<std::string> OrderDesk::carry_out(const RunRequest& request, const Give& give,
                                         const IsDriven& is_driven, Time now) {
  if (request.kind == RunRequest::Kind::kGive) {
    return leases_.give(request.robot, person_of(request), request.value, now);
  }
  if (request.kind != RunRequest::Kind::kTake) return order(request, give, is_driven, now);
  const bool forces = request.value == "force";
  // A driver over the bus, where drives have no answers.
  const bool drives = request.value == "drive";
  if (!request.value.empty() && !forces && !drives) {
    return fail(ErrorCode::kInvalidArgument, "`{}`: expected `force` or nothing", request.value);
  }
  if (drives) RAVE_TRY(sticks_.use(stick_of(request), false, now));
  auto taken = leases_.take(request.robot, person_of(request), forces, now);
  // Who takes a robot begins anew.
  if (taken) sticks_.forget(stick_of(request));
  return taken;
}

Result<std::string> OrderDesk::order(const RunRequest& request, const Give& give,
                                     const IsDriven& is_driven, Time now) {
  if (request.robot.empty()) {
    watch_.all_ended();
    ordered_.clear();
    return give(request);
  }
  if (request.kind == RunRequest::Kind::kDrive) return drive(request, give, is_driven, now);
  RAVE_TRY(leases_.use(request.robot, person_of(request), HostLeases::Use::kLook, now));
  auto answer = give(request);
  if (!answer) return answer;
  RAVE_TRY(leases_.use(request.robot, person_of(request), HostLeases::Use::kOrder, now));
  const bool words =
      request.kind == RunRequest::Kind::kText || request.kind == RunRequest::Kind::kPlace;
  if (words) return answer;
  watch_.ended(request.robot);
  leases_.drive_ended(request.robot, now);
  if (request.kind == RunRequest::Kind::kCancel) {
    ordered_.erase(request.robot);
    // A terminal has the lease only while it drives.
    if (request.by.empty()) {
      static_cast<void>(leases_.give(request.robot, person_of(request), {}, now));
    }
  } else {
    ordered_[request.robot] = request.by;
  }
  return answer;
}

Result<std::string> OrderDesk::drive(const RunRequest& request, const Give& give,
                                     const IsDriven& is_driven, Time now) {
  RAVE_TRY(leases_.use(request.robot, person_of(request), HostLeases::Use::kLook, now));
  // A drive that is renewed unchanged is no new input of the run.
  const bool known = watch_.drives(request.robot) && is_driven(request.robot);
  const bool changed =
      watch_.driven(request.robot, request.by, request.v_mps, request.w_radps, now, request.page) ||
      !known;
  Result<std::string> answer = fmt::format("{} is driven", request.robot);
  if (changed) answer = give(request);
  if (!answer) {
    watch_.ended(request.robot);
    return answer;
  }
  RAVE_TRY(leases_.use(request.robot, person_of(request), HostLeases::Use::kDrive, now));
  ordered_[request.robot] = request.by;
  return answer;
}

void OrderDesk::tick(const Give& give, Time now) {
  if (!waits()) return;
  for (const DriveWatch::Silent& silent : watch_.take_silent(now)) {
    // Refused if the robot has been stopped or removed; then it stands anyway.
    static_cast<void>(give(ended_by(RunRequest::Kind::kDrive, silent.robot, silent.by)));
    sticks_.silent({silent.robot, silent.by, silent.page}, now);
  }
  leases_.expire(now);
  follow_leases(give);
}

void OrderDesk::follow_leases(const Give& give) {
  for (HostLeases::Change& change : leases_.take_changes()) {
    const bool drove = watch_.drives(change.robot);
    const auto ordered = ordered_.find(change.robot);
    const bool gone = !change.before.empty() && ordered != ordered_.end();
    if (gone && change.after.empty()) {
      // No person holds the robot now, so its program continues.
      static_cast<void>(give(ended_by(RunRequest::Kind::kCancel, change.robot, change.before)));
      ordered_.erase(ordered);
    } else if (gone && drove) {
      // The robot stands until its new driver sends a command.
      static_cast<void>(give(ended_by(RunRequest::Kind::kDrive, change.robot, change.before)));
    }
    if (gone) watch_.ended(change.robot);
    told_.push_back(std::move(change));
  }
}

}  // namespace rave::runtime
