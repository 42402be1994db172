// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "frozen_watch.hpp"
#include "rave/robot/sample_queue.hpp"
#include "rave/robot/sight.hpp"

namespace rave::sim {

/// A range sensor of a real robot, as its guard looks at it.
struct LiveRanges {
  std::uint32_t index = 0;             ///< In the robot's type.
  const SampleQueue* queue = nullptr;  ///< Of the real half of a hybrid. Not owned.
  std::vector<Sectors> rays;           ///< Where each ray or cone looks, in the robot's frame.
};

/// The rays of a sensor; none if its driver does not say where they look.
[[nodiscard]] std::vector<Sectors> ray_sectors(const SensorInfo& sensor);

/// Where a range sensor is blind, and whether it repeats itself. One thread; update() does not
/// allocate.
class RangeWatch {
 public:
  /// `frozen_after_s`: see FrozenWatch.
  RangeWatch(LiveRanges ranges, double frozen_after_s);

  /// Takes the newest sample, if it is another than the last one.
  void update();
  /// Adds what the newest sample saw.
  void add_to(Sight& sight) const noexcept;
  [[nodiscard]] std::uint32_t index() const noexcept { return ranges_.index; }
  [[nodiscard]] FrozenWatch& frozen() noexcept { return frozen_; }
  [[nodiscard]] const FrozenWatch& frozen() const noexcept { return frozen_; }

 private:
  [[nodiscard]] bool repeats() const noexcept;

  LiveRanges ranges_;
  FrozenWatch frozen_;
  SampleHeader header_;
  std::vector<float> newest_m_;
  std::vector<float> before_m_;
  std::uint32_t before_count_ = 0;
};

}  // namespace rave::sim
