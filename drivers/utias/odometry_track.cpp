// SPDX-License-Identifier: Apache-2.0
#include "utias/odometry_track.hpp"

#include <algorithm>

namespace rave::utias {
namespace {

std::size_t first_after(std::span<const OdometrySample> samples, std::int64_t t_ns) noexcept {
  const auto found =
      std::upper_bound(samples.begin(), samples.end(), t_ns,
                       [](std::int64_t t, const OdometrySample& s) { return t < s.t_ns; });
  return static_cast<std::size_t>(found - samples.begin());
}

}  // namespace

std::optional<OdometrySample> command_at(std::span<const OdometrySample> samples,
                                         std::int64_t t_ns) noexcept {
  const std::size_t next = first_after(samples, t_ns);
  if (next == 0) return std::nullopt;
  return samples[next - 1];
}

}  // namespace rave::utias
