// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "rave/base/result.hpp"

namespace rave::line {

/// Ends the waiting of another thread: what a driver's close() rings so that its thread leaves a
/// poll at once. Stays rung until clear(). ring() may be called from any thread.
class Wake {
 public:
  Wake() = default;
  Wake(const Wake&) = delete;
  Wake& operator=(const Wake&) = delete;
  ~Wake();

  /// Must come first. Error: kIo.
  [[nodiscard]] Status open();
  void ring() noexcept;
  void clear() noexcept;
  [[nodiscard]] bool rung() const noexcept;
  /// Waits for the bell; false: it did not ring within `limit`.
  [[nodiscard]] bool wait(std::chrono::milliseconds limit) const noexcept;
  /// For poll(); readable while rung.
  [[nodiscard]] int fd() const noexcept { return fd_; }

 private:
  int fd_ = -1;
};

}  // namespace rave::line
