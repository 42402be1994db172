// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>

namespace rave {

/// Passes the newest value from one thread to another by triple buffering. Neither thread waits. A
/// value that was not taken in time is replaced by the next. The three buffers are reused, so
/// values keep their allocated memory. One writer thread, one reader thread.
template <class T>
class Latest {
 public:
  // Writer thread only.
  /// The buffer that publish() passes on; until written, it holds an earlier value.
  [[nodiscard]] T& draft() noexcept { return values_[writer_]; }
  void publish() noexcept {
    writer_ = middle_.exchange(writer_ | kFresh, std::memory_order_acq_rel) & kIndex;
  }

  // Reader thread only.
  /// Makes the newest published value current. Returns false if nothing was published since the
  /// last call; value() is then unchanged.
  bool take() noexcept {
    if ((middle_.load(std::memory_order_relaxed) & kFresh) == 0) return false;
    reader_ = middle_.exchange(reader_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  /// The value of the last successful take(); default-constructed before the first.
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
