// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>

#include "rave/base/time.hpp"
#include "rave/ros2/participant.hpp"

namespace rave::ros2 {

/// Blocks a thread until one of several readers has samples. Destroy it before the participant.
/// ring() and watch() may be called from any thread, wait() from one.
class Waiter {
 public:
  /// Error: kIo.
  [[nodiscard]] static Result<Waiter> create(const Participant& participant);
  Waiter(Waiter&& other) noexcept;
  Waiter& operator=(Waiter&&) = delete;
  ~Waiter();

  /// Adds a reader: wait() returns while it has unread samples. Pass the result to forget(); a
  /// reader that is deleted is removed automatically.
  [[nodiscard]] Result<dds_entity_t> watch(dds_entity_t reader) const;
  void forget(dds_entity_t watched) const;
  /// Ends the current wait, or else the next one.
  void ring() const noexcept;
  /// Returns when a reader has samples, after ring(), or after `limit`.
  void wait(Duration limit) const;

 private:
  Waiter() = default;

  dds_entity_t set_ = 0;
  dds_entity_t bell_ = 0;
};

}  // namespace rave::ros2
