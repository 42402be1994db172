// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "rave/math/pose.hpp"

namespace rave::recording {

/// A captured pose X_WR of robot R in the motion capture's frame W. Nanoseconds from the origin.
struct PoseSample {
  std::int64_t t_ns = 0;
  Pose2 pose;
};

/// The equivalent angle in (-pi, pi]. `angle_rad` must be finite.
[[nodiscard]] double wrap_angle(double angle_rad) noexcept;

/// The velocity of R in W, expressed in W (not in R): m/s and rad/s.
struct WorldVelocity {
  Vec2 v_WR_W;
  double wz = 0;
};

/// The captured poses of one robot over time. Immutable; may be read from any thread.
class PoseTrack {
 public:
  PoseTrack() = default;
  /// `samples`: strictly ascending in time (precondition).
  explicit PoseTrack(std::vector<PoseSample> samples);

  [[nodiscard]] std::span<const PoseSample> samples() const noexcept { return samples_; }

  /// The velocity at a time: the slope of a least-squares line through the samples within
  /// `half_window_ns`. Differences of neighbouring samples would be too noisy: stamps jitter, and
  /// one in six is less than 5 ms after the previous one. Empty unless there are three samples that
  /// span at least `half_window_ns`, so also in a wide gap and after the last sample.
  [[nodiscard]] std::optional<WorldVelocity> velocity(
      std::int64_t t_ns, std::int64_t half_window_ns = 100'000'000) const noexcept;

 private:
  /// The index of the first sample after a time.
  [[nodiscard]] std::size_t after(std::int64_t t_ns) const noexcept;

  std::vector<PoseSample> samples_;
};

}  // namespace rave::recording
