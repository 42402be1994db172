// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "rave/base/result.hpp"

namespace rave {

/// Starts `body` on `thread`, which must not be running. `body` may take a std::stop_token. `what`
/// names its owner in messages, such as "the robot". Error kIo: the system cannot create a thread.
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
