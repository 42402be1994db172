// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>

#include "rave/base/time.hpp"
#include "rave/world/snapshot.hpp"

namespace rave::sim {

/// Where an obstacle stands, if it does.
struct ObstacleState {
  Pose2 X_WB;
  bool present = false;
};

/// A change of one obstacle that counts from a time on.
struct JournalEntry {
  SimTime from;
  BodyId id;
  ObstacleState before;
  ObstacleState after;
};

/// The changes of obstacles in a run, so that a snapshot can show them as they were at a past time.
/// A snapshot shows a revision: how many changes it has seen. Where nothing changes, nothing costs.
class ObstacleJournal {
 public:
  /// How many changes there were so far; what a snapshot shows that is made now.
  [[nodiscard]] std::uint64_t revision() const noexcept { return first_ + entries_.size(); }
  /// How many of them count at `time`. Of a time before all that is remembered, those forgotten.
  [[nodiscard]] std::uint64_t revision_at(SimTime time) const noexcept;

  /// `entry.from` is not before that of the last one.
  void add(const JournalEntry& entry) { entries_.push_back(entry); }
  /// Changes that count from before `time` cannot be taken back any more.
  void forget_before(SimTime time);
  void clear() noexcept;

  /// Brings the obstacles of a snapshot from the revision `shown` to `wanted`, one of
  /// revision_at(), and notes that in `shown`. The model is that of the snapshot, as it is now.
  void show(world::Snapshot& world, std::uint64_t& shown, std::uint64_t wanted) const;

 private:
  std::deque<JournalEntry> entries_;
  std::uint64_t first_ = 0;  ///< How many were forgotten.
};

}  // namespace rave::sim
