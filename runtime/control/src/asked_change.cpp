// SPDX-License-Identifier: Apache-2.0
#include "asked_change.hpp"

#include "rave/assemble/obstacles.hpp"

namespace rave::runtime {

Result<sim::ObstacleChange> asked_change(const RunRequest& request) {
  // The place of an error within a word of the command line does not help the user, so it is
  // omitted.
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
