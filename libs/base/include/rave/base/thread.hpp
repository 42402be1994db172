// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "rave/base/result.hpp"

namespace rave {

/// Lets `thread`, which runs nothing yet, run `body`; that is given a std::stop_token if it takes
/// one. `what` names it for people: "the robot". Error (kIo): the system has no thread to give.
template <class Body>
[[nodiscard]] Status start_thread(std::jthread& thread, std::string_view what, Body&& body) {
  try {
    thread = std::jthread(std::forward<Body>(body));
  } catch (const std::system_error& e) {
    return fail(ErrorCode::kIo, "cannot start the thread of {}: {}", what, e.what());
  }
  return {};
}

}  // namespace rave
