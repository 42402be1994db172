// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>

#include "rave/base/time.hpp"
#include "rave/ros2/participant.hpp"

namespace rave::ros2 {

/// Lets a thread sleep until something has come to one of several readers. Must be gone before the
/// participant. ring() and watch() may come from any thread, wait() from one.
class Waiter {
 public:
  /// Error: kIo.
  [[nodiscard]] static Result<Waiter> create(const Participant& participant);
  Waiter(Waiter&& other) noexcept;
  Waiter& operator=(Waiter&&) = delete;
  ~Waiter();

  /// wait() ends as long as the reader has samples that nobody has looked at. What it gives is for
  /// forget(); a reader that ends is forgotten by itself.
  [[nodiscard]] Result<dds_entity_t> watch(dds_entity_t reader) const;
  void forget(dds_entity_t watched) const;
  /// Ends the wait at hand, or the next one.
  void ring() const noexcept;
  /// Until a reader has something, ring(), or the time has passed.
  void wait(Duration limit) const;

 private:
  Waiter() = default;

  dds_entity_t set_ = 0;
  dds_entity_t bell_ = 0;
};

}  // namespace rave::ros2
