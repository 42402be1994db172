// SPDX-License-Identifier: Apache-2.0
#include "rave/control/order_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rave::runtime {
namespace {

request::Request ended_by(request::Action how, const std::string& robot, const std::string& by) {
  // The name of the terminal is used in messages only.
  return {std::move(how), robot, by != HostLeases::kTerminal ? by : std::string()};
}

HostLeases::Person person_of(const request::Request& request) {
  return {request.by, request.overrides, request.page};
}

HeldSticks::Stick stick_of(const request::Request& request) {
  return {request.robot, request.by, request.page};
}

/// Whether it is a drive that lets the robot stand.
bool stands(const request::Request& request) {
  const auto* const drive = request.as<request::Drive>();
  return drive != nullptr && drive->stands();
}

}  // namespace

bool OrderDesk::is_for(const request::Action& action) noexcept {
  return request::is_order(action) || request::is_of_lease(action) ||
         std::holds_alternative<request::Release>(action) ||
         std::holds_alternative<request::HandOver>(action);
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

Status OrderDesk::check_release(const request::Request& request, Time now) {
  if (request.by.empty() || request.overrides) return {};
  if (!request.robot.empty()) {
    return leases_.use(request.robot, person_of(request), HostLeases::Use::kLook, now);
  }
  return fail(ErrorCode::kState,
              "only a super-user can release all robots; release those that you drive one by one");
}

Result<std::string> OrderDesk::serve(const request::Request& request, const Give& give,
                                     const IsDriven& is_driven, Time now) {
  leases_.expire(now);
  follow_leases(give);
  const auto* const gift = request.as<request::Give>();
  const bool gives_to_it = gift != nullptr && gift->to == HostLeases::kTerminal;
  if (request.by == HostLeases::kTerminal || gives_to_it) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not a valid name of a person",
                HostLeases::kTerminal);
  }
  if (request.is<request::Release>()) {
    RAVE_TRY(check_release(request, now));
    return give(request);
  }
  // The driver of a robot must not find a different robot in its place.
  if (request.is<request::HandOver>() && !request.robot.empty()) {
    RAVE_TRY(check_release(request, now));
    return give(request);
  }
  const bool for_all = request.is<request::Cancel>() && request.robot.empty();
  if (request.robot.empty() && !for_all) {
    return fail(ErrorCode::kInvalidArgument, "`{}` needs a robot",
                request::name_of(request.action));
  }
  if (for_all && !request.by.empty() && !request.overrides) {
    return fail(ErrorCode::kState, "only a super-user can cancel the orders of all robots");
  }
  const bool drives = request.is<request::Drive>();
  const bool of_lease = request::is_of_lease(request.action);
  if (stands(request)) {
    RAVE_TRY_ASSIGN(const auto use, look_at_stick(request, is_driven, now));
    if (use == HeldSticks::Use::kFreed) return "the stick of " + request.robot + " is neutral";
  }
  // What others send to a robot that a person drives must not use up what its driver may send.
  if (!of_lease && !request.robot.empty()) {
    const Status own = leases_.use(request.robot, person_of(request), HostLeases::Use::kLook, now);
    if (!own) return refused(request, own.error(), now);
  }
  if (drives && !stands(request)) RAVE_TRY(look_at_stick(request, is_driven, now));
  RAVE_TRY(check_rate(of_lease ? request.robot + "\n" : request.robot, now));
  auto answer = carry_out(request, give, is_driven, now);
  follow_leases(give);
  if (!answer) return refused(request, answer.error(), now);
  return answer;
}

Result<HeldSticks::Use> OrderDesk::look_at_stick(const request::Request& drive,
                                                 const IsDriven& is_driven, Time now) {
  const HeldSticks::Stick stick = stick_of(drive);
  // A stop ends a drive in the run; the stick may still be held when the robot is released.
  if (watch_.moves(drive.robot, drive.by, drive.page) && !is_driven(drive.robot)) {
    watch_.ended(drive.robot);
    sticks_.hold(stick, drive.robot + " was stopped while it was driven", now);
  }
  return sticks_.use(stick, stands(drive), now);
}

tl::unexpected<Error> OrderDesk::refused(const request::Request& request, Error why, Time now) {
  // Another error is a mistake in the request, which the next one may not have.
  const bool held =
      request.is<request::Drive>() && !stands(request) && why.code == ErrorCode::kState;
  if (held) sticks_.hold(stick_of(request), why.message, now);
  return tl::unexpected(std::move(why));
}

Result<std::string> OrderDesk::carry_out(const request::Request& request, const Give& give,
                                         const IsDriven& is_driven, Time now) {
  if (const auto* const gift = request.as<request::Give>()) {
    return leases_.give(request.robot, person_of(request), gift->to, now);
  }
  const auto* const take = request.as<request::Take>();
  if (take == nullptr) return order(request, give, is_driven, now);
  if (take->drives) RAVE_TRY(sticks_.use(stick_of(request), false, now));
  auto taken = leases_.take(request.robot, person_of(request), take->force, now);
  // Who takes a robot begins anew.
  if (taken) sticks_.forget(stick_of(request));
  return taken;
}

Result<std::string> OrderDesk::order(const request::Request& request, const Give& give,
                                     const IsDriven& is_driven, Time now) {
  if (request.robot.empty()) {
    watch_.all_ended();
    ordered_.clear();
    return give(request);
  }
  if (const auto* const velocity = request.as<request::Drive>()) {
    return drive(request, *velocity, give, is_driven, now);
  }
  RAVE_TRY(leases_.use(request.robot, person_of(request), HostLeases::Use::kLook, now));
  auto answer = give(request);
  if (!answer) return answer;
  RAVE_TRY(leases_.use(request.robot, person_of(request), HostLeases::Use::kOrder, now));
  if (request.is<request::Text, request::Place>()) return answer;
  watch_.ended(request.robot);
  leases_.drive_ended(request.robot, now);
  if (request.is<request::Cancel>()) {
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

Result<std::string> OrderDesk::drive(const request::Request& request,
                                     const request::Drive& velocity, const Give& give,
                                     const IsDriven& is_driven, Time now) {
  RAVE_TRY(leases_.use(request.robot, person_of(request), HostLeases::Use::kLook, now));
  // A drive that is renewed unchanged is no new input of the run.
  const bool known = watch_.drives(request.robot) && is_driven(request.robot);
  const bool changed =
      watch_.driven(request.robot, request.by, velocity, now, request.page) || !known;
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
    static_cast<void>(give(ended_by(request::Drive(), silent.robot, silent.by)));
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
      static_cast<void>(give(ended_by(request::Cancel(), change.robot, change.before)));
      ordered_.erase(ordered);
    } else if (gone && drove) {
      // The robot stands until its new driver sends a command.
      static_cast<void>(give(ended_by(request::Drive(), change.robot, change.before)));
    }
    if (gone) watch_.ended(change.robot);
    told_.push_back(std::move(change));
  }
}

}  // namespace rave::runtime
