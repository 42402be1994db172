// SPDX-License-Identifier: Apache-2.0
// Inputs since the last step. They become events of the step that begins next, because each event
// belongs to one step.
#include "input_log.hpp"

#include <utility>

namespace rave::sim {

void InputLog::clear() {
  events_.clear();
  by_hand_ = 0;
}

void InputLog::note(std::uint64_t step, RobotId robot, EventKind kind, std::string text,
                    const Author& author) {
  count(author);
  note_outcome(step, robot, kind, std::move(text), author);
}

void InputLog::note_outcome(std::uint64_t step, RobotId robot, EventKind kind, std::string text,
                            const Author& author) {
  events_.push_back(noted_input(step, robot, kind, std::move(text), author, hash_));
}

const std::string& InputLog::note_obstacle(std::uint64_t step, const ObstacleChange& change,
                                           std::string_view also, const Author& author) {
  count(author);
  return events_.emplace_back(noted_obstacle(step, change, also, author, hash_)).text;
}

void InputLog::note_order(std::uint64_t step, const WorldInput& input, EventKind kind) {
  count(input.author);
  events_.push_back(noted_order(step, input, kind, hash_));
}

void InputLog::count_order(std::uint64_t step, const WorldInput& input, EventKind kind) {
  count(input.author);
  // In the hash, but no event: a stick gives many orders a second.
  static_cast<void>(noted_order(step, input, kind, hash_));
}

void InputLog::begin_step(std::vector<Event>& events) {
  events.swap(events_);  // both keep their room
  events_.clear();
}

void InputLog::add_to(std::vector<Event>& events) {
  events.insert(events.end(), events_.begin(), events_.end());
  events_.clear();
}

}  // namespace rave::sim
