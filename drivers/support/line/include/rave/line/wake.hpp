// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <thread>

#include "rave/base/descriptor.hpp"
#include "rave/base/result.hpp"

namespace rave::line {

/// Interrupts a wait of another thread: a driver's close() rings it so that its thread leaves
/// poll() at once. It stays rung until clear(). ring() may be called from any thread.
class Wake {
 public:
  Wake() = default;
  Wake(const Wake&) = delete;
  Wake& operator=(const Wake&) = delete;
  ~Wake() = default;

  /// Call it first. Error: kIo.
  [[nodiscard]] Status open();
  void ring() noexcept;
  void clear() noexcept;
  /// Ends a thread that waits for this bell: asks it to stop, rings and joins it, if it runs.
  void end(std::jthread& thread) noexcept;
  /// Waits for the bell; false: it did not ring within `limit`.
  [[nodiscard]] bool wait(std::chrono::milliseconds limit) const noexcept;
  /// Descriptor for poll(); readable after ring() until clear().
  [[nodiscard]] int fd() const noexcept { return event_.get(); }

 private:
  Descriptor event_;
};

}  // namespace rave::line
