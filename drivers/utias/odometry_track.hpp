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

/// The path of a robot that obeys the commands exactly: each command holds until the next and moves
/// the robot along an arc. Returns the pose at `from_ns` (= `start`), at every command, at least
/// every 0.1 s, and at `to_ns`. It stands still before the first command. `samples`: ascending in
/// time. Empty if to_ns < from_ns.
[[nodiscard]] std::vector<PoseSample> integrate_odometry(std::span<const OdometrySample> samples,
                                                         const Pose2& start, std::int64_t from_ns,
                                                         std::int64_t to_ns);

}  // namespace rave::utias
