// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "input_notes.hpp"

namespace rave::sim {

/// What was asked of a run between two steps, as it is written down: an event of the step that
/// comes next, and a part of the run hash. `step` is that step. Belongs to the thread of the
/// engine.
class InputLog {
 public:
  /// Adds to `hash`, which must outlive it.
  explicit InputLog(RunHash& hash) : hash_(hash) {}

  /// A run begins.
  void clear();
  void note(std::uint64_t step, RobotId robot, EventKind kind, std::string text,
            const Author& author);
  /// What came of something that was asked for earlier, and counted then.
  void note_outcome(std::uint64_t step, RobotId robot, EventKind kind, std::string text,
                    const Author& author);
  /// Returns the text of the event. `also`: what else is worth telling.
  const std::string& note_obstacle(std::uint64_t step, const ObstacleChange& change,
                                   std::string_view also, const Author& author);
  void note_order(std::uint64_t step, const WorldInput& input, EventKind kind);
  /// An input that only continues, as a joystick repeats it many times a second: no event.
  void count_order(std::uint64_t step, const WorldInput& input, EventKind kind);
  /// Something was asked for; what came of it is noted later.
  void count(const Author& author) { by_hand_ += author.by_hand ? 1 : 0; }

  /// The events become those of a step that begins, in the place of what was there.
  void begin_step(std::vector<Event>& events);
  /// They are added to those of a step that has begun.
  void add_to(std::vector<Event>& events);
  /// How many inputs came by hand.
  [[nodiscard]] std::uint64_t by_hand() const noexcept { return by_hand_; }

 private:
  RunHash& hash_;
  std::vector<Event> events_;
  std::uint64_t by_hand_ = 0;
};

}  // namespace rave::sim
