// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <future>
#include <string_view>
#include <system_error>
#include <thread>
#include <type_traits>
#include <utility>

#include "rave/base/result.hpp"

namespace rave {

/// Starts `body` on `thread`, which must not be running. `body` may take a std::stop_token. `what`
/// names its owner in messages, such as "the robot". Error kIo: the system cannot create a thread.
template <class Thread, class Body>
  requires std::same_as<Thread, std::jthread> || std::same_as<Thread, std::thread>
[[nodiscard]] Status start_thread(Thread& thread, std::string_view what, Body&& body) {
  try {
    thread = Thread(std::forward<Body>(body));
  } catch (const std::system_error& e) {
    return fail(ErrorCode::kIo, "cannot start the thread of {}: {}", what, e.what());
  }
  return {};
}

/// The result of `work`, which has a thread of its own, or where the system creates none the thread
/// that asks for the result.
template <class Work>
[[nodiscard]] std::future<std::invoke_result_t<Work>> start_beside(Work work) {
  try {
    return std::async(std::launch::async, work);
  } catch (const std::system_error&) {
    return std::async(std::launch::deferred, std::move(work));
  }
}

}  // namespace rave
