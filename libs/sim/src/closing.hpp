// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <vector>

#include "rave/base/ids.hpp"

namespace rave::sim {

/// A driver that has to be closed.
struct ToClose {
  RobotId robot{};
  const char* kind = "";  ///< What it drives: "sensor", ...
  const char* name = "";
  const char* driver = "";
  void (*close)(void* instance) = nullptr;
  void* instance = nullptr;
  /// Others of this robot may use it, so it stays open if one of them does not return.
  bool is_shared = false;
  const char* robot_name = "";  ///< For crashes.
};

/// Closes drivers in their order, in a thread of its own, and returns those that have not returned
/// within `limit` (after the first of them: a second at most). Their threads live as long as
/// the process does, and with them `owner`, which is what their drivers use; no thread waits for
/// them. Without drivers there is no thread.
[[nodiscard]] std::vector<ToClose> close_within(std::vector<ToClose> drivers,
                                                std::chrono::milliseconds limit, const void* owner);

}  // namespace rave::sim
