// SPDX-License-Identifier: Apache-2.0
#include "recording/pose_track.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "rave/base/check.hpp"

namespace rave::recording {
namespace {

/// The slope of a least-squares line, from the sums over its points.
class LineFit {
 public:
  void add(double t_s, double x, double y, double yaw) noexcept {
    ++count_;
    t_ += t_s;
    tt_ += t_s * t_s;
    add(x_, t_s, x);
    add(y_, t_s, y);
    add(yaw_, t_s, yaw);
  }
  [[nodiscard]] WorldVelocity slope() const noexcept {
    return {{slope_of(x_), slope_of(y_)}, slope_of(yaw_)};
  }

 private:
  struct Sums {
    double value = 0;
    double product = 0;
  };
  static void add(Sums& sums, double t_s, double value) noexcept {
    sums.value += value;
    sums.product += t_s * value;
  }
  [[nodiscard]] double slope_of(const Sums& sums) const noexcept {
    const double spread = count_ * tt_ - t_ * t_;
    return spread > 0 ? (count_ * sums.product - t_ * sums.value) / spread : 0;
  }

  double count_ = 0;
  double t_ = 0;
  double tt_ = 0;
  Sums x_;
  Sums y_;
  Sums yaw_;
};

}  // namespace

double wrap_angle(double angle_rad) noexcept {
  const double wrapped = std::remainder(angle_rad, 2 * std::numbers::pi);
  return wrapped <= -std::numbers::pi ? wrapped + 2 * std::numbers::pi : wrapped;
}

PoseTrack::PoseTrack(std::vector<PoseSample> samples) : samples_(std::move(samples)) {
  for (std::size_t i = 1; i < samples_.size(); ++i) {
    RAVE_CHECK(samples_[i - 1].t_ns < samples_[i].t_ns);
  }
}

std::size_t PoseTrack::after(std::int64_t t_ns) const noexcept {
  const auto found =
      std::upper_bound(samples_.begin(), samples_.end(), t_ns,
                       [](std::int64_t t, const PoseSample& sample) { return t < sample.t_ns; });
  return static_cast<std::size_t>(found - samples_.begin());
}

std::optional<WorldVelocity> PoseTrack::velocity(std::int64_t t_ns,
                                                 std::int64_t half_window_ns) const noexcept {
  const std::size_t end = after(t_ns + half_window_ns);
  std::size_t begin = after(t_ns - half_window_ns);
  if (begin > 0 && samples_[begin - 1].t_ns == t_ns - half_window_ns) --begin;
  // Fewer than three samples, or a window filled on one side only, give the slope of noise.
  if (end < begin + 3 || samples_.back().t_ns < t_ns) return std::nullopt;
  if (samples_[end - 1].t_ns - samples_[begin].t_ns < half_window_ns) return std::nullopt;
  // Relative to the first sample: small numbers keep the sums precise.
  const PoseSample& base = samples_[begin];
  LineFit fit;
  double yaw = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const PoseSample& sample = samples_[i];
    // The heading is unwrapped: a line through values that jump by a turn has no meaning.
    if (i > begin) yaw += wrap_angle(sample.pose.yaw - samples_[i - 1].pose.yaw);
    fit.add(static_cast<double>(sample.t_ns - base.t_ns) * 1e-9, sample.pose.x - base.pose.x,
            sample.pose.y - base.pose.y, yaw);
  }
  return fit.slope();
}

}  // namespace rave::recording
