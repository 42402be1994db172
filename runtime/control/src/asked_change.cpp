// SPDX-License-Identifier: Apache-2.0
#include "asked_change.hpp"

#include "rave/assemble/obstacles.hpp"

namespace rave::runtime {

Result<sim::ObstacleChange> asked_change(const RunRequest& request) {
  // Where within the word of a command line something is wrong tells nobody anything.
  const auto without_place = [](const Error& error) {
    return fail(error.code, "{}", error.message);
  };
  if (request.kind == RunRequest::Kind::kRemove) return removal(request.key);
  if (request.kind == RunRequest::Kind::kMove) {
    const auto file = config::read_move_text(request.value, "");
    if (!file) return without_place(file.error());
    return move_of(*file);
  }
  const auto file = config::read_obstacle_text(request.value, "");
  if (!file) return without_place(file.error());
  auto obstacle = make_obstacle(*file);
  if (!obstacle) return without_place(obstacle.error());
  return addition(*std::move(obstacle));
}

}  // namespace rave::runtime
