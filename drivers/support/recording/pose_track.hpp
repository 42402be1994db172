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

/// The angle brought into (-pi, pi]. `angle_rad` must be finite.
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
  /// `samples`: strictly ascending in time (a programmer's mistake otherwise).
  explicit PoseTrack(std::vector<PoseSample> samples);

  [[nodiscard]] std::span<const PoseSample> samples() const noexcept { return samples_; }

  /// The pose at a moment: linear between the two samples around it, heading by the shorter turn.
  /// After the last sample the last pose is held, for the body is still there: ask `age_ns`.
  /// None before the first sample.
  [[nodiscard]] std::optional<Pose2> interpolate(std::int64_t t_ns) const noexcept;

  /// The stamp of the latest sample at or before a moment; none before the first.
  [[nodiscard]] std::optional<std::int64_t> last_stamp_ns(std::int64_t t_ns) const noexcept;

  /// How old the latest sample is at a moment; none before the first.
  [[nodiscard]] std::optional<std::int64_t> age_ns(std::int64_t t_ns) const noexcept;

  /// Whether a moment lies between two samples that are more than `limit_ns` apart, more than
  /// that after the last sample, or before the first. A moment with a sample is in no gap.
  [[nodiscard]] bool in_gap(std::int64_t t_ns, std::int64_t limit_ns) const noexcept;

  /// The velocity at a moment: the slope of the straight line fitted by least squares to the
  /// samples within `half_window_ns` of it. Differences of neighbours are useless here: stamps
  /// jitter, a sixth of them is under 5 ms apart. None unless there are three samples that span
  /// at least `half_window_ns`, so not in a wide gap and not after the last sample.
  [[nodiscard]] std::optional<WorldVelocity> velocity(
      std::int64_t t_ns, std::int64_t half_window_ns = 100'000'000) const noexcept;

 private:
  /// The index of the first sample after a moment.
  [[nodiscard]] std::size_t after(std::int64_t t_ns) const noexcept;

  std::vector<PoseSample> samples_;
};

}  // namespace rave::recording
