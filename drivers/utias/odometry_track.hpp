// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "utias/recording_names.hpp"

namespace rave::utias {

/// A row of the "Odometry" log, which holds the *commanded* velocity. Nanoseconds from the origin.
struct OdometrySample {
  std::int64_t t_ns = 0;
  double v_mps = 0;
  double w_radps = 0;
};

/// The command in force at a time: the latest at or before it, of any age, because the log comes in
/// bursts. Empty before the first. `samples`: ascending in time.
[[nodiscard]] std::optional<OdometrySample> command_at(std::span<const OdometrySample> samples,
                                                       std::int64_t t_ns) noexcept;

}  // namespace rave::utias
