// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "rave/base/time.hpp"
#include "rave/math/transform.hpp"

namespace rave::sim {

/// The last poses that were reported for one robot, with their stamps, newest last.
class PoseTrack {
 public:
  explicit PoseTrack(Duration keep) : keep_(keep) {}

  /// False: it is not newer than the newest one, and is left out.
  bool add(SimTime stamp, const Pose2& X_WR) {
    if (!samples_.empty() && stamp <= samples_.back().stamp) return false;
    std::size_t old = 0;
    while (old + 2 < samples_.size() && samples_[old + 1].stamp < stamp - keep_) ++old;
    // Shifting a few hundred small entries now and then is cheaper than a ring with seams.
    if (old > 64) samples_.erase(samples_.begin(), samples_.begin() + static_cast<long>(old));
    samples_.push_back({stamp, X_WR});
    return true;
  }

  void clear() noexcept { samples_.clear(); }

  /// Interpolated between samples; after the newest one, that one. Nothing before the oldest.
  [[nodiscard]] std::optional<Pose2> at(SimTime t) const {
    if (samples_.empty() || t < samples_.front().stamp) return std::nullopt;
    if (t >= samples_.back().stamp) return samples_.back().X_WR;
    std::size_t i = samples_.size() - 1;
    while (samples_[i].stamp > t) --i;
    const Sample& a = samples_[i];
    const Sample& b = samples_[i + 1];
    const double s =
        static_cast<double>((t - a.stamp).ns) / static_cast<double>((b.stamp - a.stamp).ns);
    return interpolate(a.X_WR, b.X_WR, s);
  }

  /// As at(), but after the newest sample moved on from it with velocity() for the time since, at
  /// most `longest`. Nothing before the oldest.
  [[nodiscard]] std::optional<Pose2> carried_to(SimTime t, Duration longest) const {
    if (samples_.empty() || t <= samples_.back().stamp) return at(t);
    const Duration since = std::min(t - samples_.back().stamp, longest);
    return integrate(samples_.back().X_WR, velocity(), since.seconds());
  }

  /// Stamp of the newest sample; nothing if there is none.
  [[nodiscard]] std::optional<SimTime> newest() const {
    if (samples_.empty()) return std::nullopt;
    return samples_.back().stamp;
  }

  /// The mean body velocity over the last quarter of a second: long enough that the noise of
  /// motion capture, divided by it, stays below a few mm/s. Zero with fewer than two samples.
  [[nodiscard]] Twist2 velocity() const {
    constexpr Duration kWindow{250'000'000};
    constexpr Duration kLeast{20'000'000};
    if (samples_.size() < 2) return {};
    const Sample& last = samples_.back();
    std::size_t i = samples_.size() - 1;
    while (i > 0 && last.stamp - samples_[i - 1].stamp <= kWindow) --i;
    const Duration span = last.stamp - samples_[i].stamp;
    if (span < kLeast) return {};
    return twist_between(samples_[i].X_WR, last.X_WR, span.seconds());
  }

 private:
  struct Sample {
    SimTime stamp;
    Pose2 X_WR;
  };
  Duration keep_;
  std::vector<Sample> samples_;
};

}  // namespace rave::sim
