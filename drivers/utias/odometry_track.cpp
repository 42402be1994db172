// SPDX-License-Identifier: Apache-2.0
#include "utias/odometry_track.hpp"

#include <algorithm>
#include <cmath>

#include "rave/math/scalar.hpp"

namespace rave::utias {
namespace {

constexpr std::int64_t kLongestPiece_ns = 100'000'000;

std::size_t first_after(std::span<const OdometrySample> samples, std::int64_t t_ns) noexcept {
  const auto found =
      std::upper_bound(samples.begin(), samples.end(), t_ns,
                       [](std::int64_t t, const OdometrySample& s) { return t < s.t_ns; });
  return static_cast<std::size_t>(found - samples.begin());
}

/// The pose after `length_ns` at constant forward and turning speed. The chord of the arc points
/// along the mean heading and is sin(h)/h times as long, where h is half the turn.
Pose2 move_on_arc(const Pose2& from, const OdometrySample& command, std::int64_t length_ns) {
  const double dt_s = static_cast<double>(length_ns) * 1e-9;
  const double half_turn = 0.5 * command.w_radps * dt_s;
  const double shrink =
      std::abs(half_turn) < 1e-4 ? 1 - half_turn * half_turn / 6 : rave::sin(half_turn) / half_turn;
  const double chord_m = command.v_mps * dt_s * shrink;
  const double heading = from.yaw + half_turn;
  return {from.x + chord_m * rave::cos(heading), from.y + chord_m * rave::sin(heading),
          wrap_angle(from.yaw + 2 * half_turn)};
}

}  // namespace

std::optional<OdometrySample> command_at(std::span<const OdometrySample> samples,
                                         std::int64_t t_ns) noexcept {
  const std::size_t next = first_after(samples, t_ns);
  if (next == 0) return std::nullopt;
  return samples[next - 1];
}

std::vector<PoseSample> integrate_odometry(std::span<const OdometrySample> samples,
                                           const Pose2& start, std::int64_t from_ns,
                                           std::int64_t to_ns) {
  std::vector<PoseSample> track;
  if (to_ns < from_ns) return track;
  track.push_back({from_ns, start});
  std::size_t next = first_after(samples, from_ns);
  std::int64_t t_ns = from_ns;
  Pose2 pose = start;
  while (t_ns < to_ns) {
    std::int64_t until = std::min(to_ns, t_ns + kLongestPiece_ns);
    if (next < samples.size()) until = std::min(until, samples[next].t_ns);
    if (next > 0) pose = move_on_arc(pose, samples[next - 1], until - t_ns);
    t_ns = until;
    track.push_back({t_ns, pose});
    while (next < samples.size() && samples[next].t_ns <= t_ns) ++next;
  }
  return track;
}

}  // namespace rave::utias
