// SPDX-License-Identifier: Apache-2.0
#include "rave/control/host_leases.hpp"

#include <fmt/format.h>

#include <utility>

namespace rave::runtime {
namespace {

const std::string kNobody;

std::string_view name_of(const HostLeases::Person& person) {
  return person.name.empty() ? HostLeases::kTerminal : person.name;
}

/// What tells two leases of the same name apart.
std::string_view place_of(std::string_view holder) {
  return holder == HostLeases::kTerminal ? "terminal" : "page";
}

}  // namespace

std::string lease_text(const HostLeases::Change& change) {
  if (change.after.empty()) {
    return fmt::format("`{}` no longer drives{}", change.before,
                       change.expired ? ": no message came from them" : "");
  }
  if (change.before.empty()) return fmt::format("`{}` drives", change.after);
  if (change.before == change.after)
    return fmt::format("`{}` drives on another {}", change.after, place_of(change.after));
  return fmt::format("`{}` drives now, instead of `{}`", change.after, change.before);
}

const HostLeases::Lease* HostLeases::find(const std::string& robot) const noexcept {
  const auto found = leases_.find(robot);
  return found == leases_.end() ? nullptr : &found->second;
}

const std::string& HostLeases::holder(const std::string& robot) const noexcept {
  const Lease* const lease = find(robot);
  return lease != nullptr ? lease->holder : kNobody;
}

std::uint64_t HostLeases::page(const std::string& robot) const noexcept {
  const Lease* const lease = find(robot);
  return lease != nullptr ? lease->page : 0;
}

bool HostLeases::owns(const Lease& lease, const Person& person) noexcept {
  return lease.holder == name_of(person) && (lease.page == 0 || lease.page == person.page);
}

tl::unexpected<Error> HostLeases::refusal(const std::string& robot, const Lease& lease,
                                          const Person& person) {
  if (person.name.empty() && lease.holder == HostLeases::kTerminal) {
    return fail(ErrorCode::kState, "another terminal drives {}; `--force` takes it from there",
                robot);
  }
  if (lease.holder == name_of(person)) {
    return fail(ErrorCode::kState,
                "you drive {} on another page: give it back there, or take it here", robot);
  }
  return fail(ErrorCode::kState, "`{}` drives {}", lease.holder, robot);
}

void HostLeases::set(const std::string& robot, const Person& holder, bool driven, Time now) {
  Lease& lease = leases_[robot];
  if (!owns(lease, holder)) {
    changes_.push_back({robot, lease.holder, std::string(name_of(holder)), lease.driven, false});
    lease.holder = name_of(holder);
  }
  lease.page = holder.page;
  lease.driven = driven;
  lease.until = driven ? now + kAfterDrive : now + kAfterOrder;
}

Status HostLeases::use(const std::string& robot, const Person& person, Use how, Time now) {
  const Lease* const lease = find(robot);
  const bool own = lease != nullptr && owns(*lease, person);
  if (lease != nullptr && !own) return refusal(robot, *lease, person);
  // A single order from the terminal must not keep other people from the robot for minutes.
  const bool takes = how == Use::kDrive || (how == Use::kOrder && (own || !person.name.empty()));
  if (takes) set(robot, person, how == Use::kDrive, now);
  return {};
}

Result<std::string> HostLeases::take(const std::string& robot, const Person& person, bool force,
                                     Time now) {
  const Lease* const lease = find(robot);
  const bool own = lease != nullptr && owns(*lease, person);
  const bool rights = force || person.overrides || person.name.empty();
  if (lease != nullptr && !own && !rights) return refusal(robot, *lease, person);
  const std::string before = lease != nullptr && !own ? lease->holder : "";
  set(robot, person, own && lease->driven, now);
  if (before.empty()) return fmt::format("{} is yours", robot);
  if (before == name_of(person)) {
    return fmt::format("{} is yours; it was taken from another {} of yours", robot,
                       place_of(before));
  }
  return fmt::format("{} is yours; it was taken from `{}`", robot, before);
}

Result<std::string> HostLeases::give(const std::string& robot, const Person& person,
                                     const std::string& to, Time now) {
  const Lease* const lease = find(robot);
  const bool rights = person.overrides || person.name.empty();
  // A page that goes has asked for many robots perhaps, and takes none with that.
  const bool to_oneself = to == name_of(person);
  if (lease == nullptr && (to.empty() || to_oneself)) {
    return fail(ErrorCode::kInvalidArgument, "no person drives {}", robot);
  }
  if (lease != nullptr && !owns(*lease, person) && (!rights || to_oneself)) {
    return refusal(robot, *lease, person);
  }
  if (to_oneself) {
    leases_.at(robot).page = 0;
    return fmt::format("any of your pages can drive {} now", robot);
  }
  if (!to.empty()) {
    set(robot, Person{to}, false, now);
    return fmt::format("{} is given to `{}`", robot, to);
  }
  changes_.push_back({robot, lease->holder, "", lease->driven, false});
  leases_.erase(robot);
  return fmt::format("no person drives {} now", robot);
}

void HostLeases::drive_ended(const std::string& robot, Time now) {
  const auto found = leases_.find(robot);
  if (found == leases_.end() || !found->second.driven) return;
  found->second.driven = false;
  found->second.until = now + kAfterOrder;
}

void HostLeases::expire(Time now) {
  for (auto lease = leases_.begin(); lease != leases_.end();) {
    if (now < lease->second.until) {
      ++lease;
      continue;
    }
    changes_.push_back({lease->first, lease->second.holder, "", lease->second.driven, true});
    lease = leases_.erase(lease);
  }
}

std::vector<HostLeases::Change> HostLeases::take_changes() { return std::exchange(changes_, {}); }

}  // namespace rave::runtime
