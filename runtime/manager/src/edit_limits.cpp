// SPDX-License-Identifier: Apache-2.0
#include "edit_limits.hpp"

#include <algorithm>

#include "rave/protocol/obstacle_messages.hpp"

// Edits are limited for two reasons: in lock-step a step carries all of its changes in one message,
// and a host that joins late must receive all changes since the start. The first limit is a token
// bucket for edits and bytes, refilled with time up to one second's allowance. The second one
// counts entries and bytes of the whole run.
namespace rave::manager {

Status EditLimits::take(const sim::ObstacleChange& change, Clock::time_point now) {
  // First of all, because a change that no host can decode must not use up the allowance.
  RAVE_TRY(lock_step::check_fits(change));
  const auto bytes = static_cast<double>(lock_step::wire_bytes(change));
  if (filled_ != Clock::time_point{}) {
    const double since_s = std::chrono::duration<double>(now - filled_).count();
    edits_ = std::min(kPerSecond, edits_ + since_s * kPerSecond);
    bytes_ = std::min(kBytesPerSecond, bytes_ + since_s * kBytesPerSecond);
  }
  filled_ = now;
  if (edits_ < 1 || bytes_ < bytes) {
    return fail(ErrorCode::kState,
                "too many edits at once: a run of several processes takes {} per second, and {} "
                "MB; try again later",
                kPerSecond, kBytesPerSecond * 1e-6);
  }
  // A removal is permitted even at the limit. Otherwise no room could be made.
  const bool grows = change.kind != sim::ObstacleChange::Kind::kRemove;
  if (grows && (entries_ >= kMostEntries ||
                all_bytes_ + static_cast<std::size_t>(bytes) > lock_step::kMostObstacleBytes)) {
    return fail(ErrorCode::kState,
                "too many obstacles were added or changed for hosts that join late: {} of at most "
                "{}, {} of at most {} bytes",
                entries_, kMostEntries, all_bytes_, lock_step::kMostObstacleBytes);
  }
  if (open_ >= kMostOpen) {
    return fail(ErrorCode::kState,
                "{} edits are waiting for the next step, which is the maximum; try again later",
                open_);
  }
  ++open_;
  edits_ -= 1;
  bytes_ -= bytes;
  return {};
}

void EditLimits::made(const sim::ObstacleChange& change) {
  // The removal of an added obstacle was counted when it was added.
  if (!changed_.insert(change.id.value()).second) return;
  // An added obstacle counts twice: for the addition, and for its possible removal later.
  entries_ += change.kind == sim::ObstacleChange::Kind::kAdd ? 2 : 1;
  all_bytes_ += lock_step::wire_bytes(change) - change.asked.size();
}

Status check_scheduled(const sim::EngineSpec& spec) {
  std::size_t bytes = 0;
  for (const sim::ScheduledObstacle& scheduled : spec.obstacle_changes) {
    RAVE_TRY(lock_step::check_fits(scheduled.change));
    bytes += lock_step::wire_bytes(scheduled.change);
  }
  if (spec.obstacle_changes.size() <= EditLimits::kMostEntries &&
      bytes <= lock_step::kMostObstacleBytes) {
    return {};
  }
  return fail(ErrorCode::kInvalidArgument,
              "the scenario changes obstacles {} times, in {} bytes; expected at most {} and {} "
              "bytes, so that hosts can join late",
              spec.obstacle_changes.size(), bytes, EditLimits::kMostEntries,
              lock_step::kMostObstacleBytes);
}

}  // namespace rave::manager
