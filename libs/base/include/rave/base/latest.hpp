// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>

namespace rave {

/// Hands values from one thread to another, the newest only: neither waits, and what nobody took in
/// time is replaced. Three buffers, so that the memory of values is used again (triple buffering).
template <class T>
class Latest {
 public:
  // The thread that writes.
  /// What publish() hands over; holds some earlier value before.
  [[nodiscard]] T& draft() noexcept { return values_[writer_]; }
  void publish() noexcept {
    writer_ = middle_.exchange(writer_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  // The thread that reads.
  /// False: nothing has been published since the last call, and value() stays what it is.
  bool take() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    reader_ = middle_.exchange(reader_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  /// What the last take() got; a default value before.
  [[nodiscard]] const T& value() const noexcept { return values_[reader_]; }

 private:
  static constexpr unsigned kFresh = 4;
  static constexpr unsigned kIndex = 3;
  std::array<T, 3> values_{};
  unsigned writer_ = 0;
  unsigned reader_ = 1;
  std::atomic<unsigned> middle_{2};
};

}  // namespace rave
