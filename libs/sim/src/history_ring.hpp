// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "rave/base/time.hpp"
#include "rave/world/snapshot.hpp"

namespace rave::sim {

/// The world at the end of one past step, for looking back.
struct HistoryFrame {
  SimTime time;
  std::vector<world::RobotState> robots;
  std::vector<TouchState> touch;
};

/// The last frames, oldest first. Once it is as long as it gets, no call allocates.
class HistoryRing {
 public:
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] const HistoryFrame& operator[](std::size_t i) const noexcept {
    return frames_[(first_ + i) % frames_.size()];
  }
  [[nodiscard]] const HistoryFrame& front() const noexcept { return (*this)[0]; }
  [[nodiscard]] const HistoryFrame& back() const noexcept { return (*this)[count_ - 1]; }

  /// Forgets all frames and keeps their memory.
  void clear() noexcept { first_ = count_ = 0; }
  /// Forgets the oldest frame and keeps its memory.
  void drop_oldest() noexcept {
    first_ = (first_ + 1) % frames_.size();
    --count_;
  }
  /// A new frame at the end, to be overwritten: it holds what an older one held.
  HistoryFrame& add() {
    if (count_ == frames_.size()) {
      std::vector<HistoryFrame> longer;
      longer.reserve(2 * count_ + 8);
      for (std::size_t i = 0; i < count_; ++i) {
        longer.push_back(std::move(frames_[(first_ + i) % frames_.size()]));
      }
      longer.resize(2 * count_ + 8);
      frames_ = std::move(longer);
      first_ = 0;
    }
    return frames_[(first_ + count_++) % frames_.size()];
  }

 private:
  std::vector<HistoryFrame> frames_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

}  // namespace rave::sim
