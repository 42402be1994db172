// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/robot/sample_queue.hpp"

namespace rave {

/// Of two values in each sample.
inline SampleQueue values(std::size_t depth, const RunClock* live = nullptr) {
  return SampleQueue(ReadingKind::kValues, 2, depth, live);
}

inline bool put(SampleQueue& queue, std::int64_t stamp_ns, double value) {
  return queue.publish({stamp_ns}, &value, 1);
}

/// Stamps of all samples up to `up_to`, in the order in which they come out.
inline std::vector<std::int64_t> take(SampleQueue& queue, SimTime up_to) {
  std::vector<std::int64_t> stamps;
  SampleHeader header;
  double records[2];
  while (queue.next(up_to, &header, records)) stamps.push_back(header.stamp_ns);
  return stamps;
}

using Stamps = std::vector<std::int64_t>;

}  // namespace rave
