// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <vector>

#include "rave/base/check.hpp"
#include "rave/base/random.hpp"
#include "rave/robot/processing.hpp"

namespace rave {

inline constexpr float kNoReturn = std::numeric_limits<float>::infinity();

inline Processing made(const ProcessingSpec& spec, ReadingKind kind, std::uint32_t capacity,
                       double period_s = 0.01) {
  auto chain = Processing::make(spec, kind, capacity, period_s);
  RAVE_CHECK(chain.has_value());
  return *std::move(chain);
}

/// The random numbers of a sample.
inline RandomStream stream(std::uint32_t sample) { return {7, 3, 2, sample}; }

inline SampleHeader header_of(std::int64_t stamp_ns, std::uint32_t count) {
  SampleHeader header;
  header.stamp_ns = stamp_ns;
  header.sequence = 1;
  header.count = count;
  return header;
}

inline std::vector<std::byte> fresh_state(const Processing& chain) {
  std::vector<std::byte> state(chain.state_size());
  chain.reset(state.data());
  return state;
}

}  // namespace rave
