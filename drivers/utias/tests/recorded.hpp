// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rave/math/transform.hpp"
#include "utias/dataset.hpp"

namespace rave::utias {

inline constexpr std::int64_t kMillisecond_ns = 1'000'000;
inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

inline std::filesystem::path stretch_folder(const std::string& name) {
  return std::filesystem::path(RAVE_SOURCE_DIR) / "data" / "utias-mrclam6" / name;
}

/// A shipped stretch; the test fails and an empty set is given if it does not load.
inline Dataset recorded(const std::string& name, const LoadOptions& options = {}) {
  auto data = load(stretch_folder(name), options);
  if (data) return std::move(*data);
  ADD_FAILURE() << data.error().text();
  return {};
}

/// The last sample at or before a time; null before the first.
template <class Sample>
const Sample* held_at(std::span<const Sample> samples, std::int64_t t_ns) {
  const auto after = std::ranges::upper_bound(samples, t_ns, {}, &Sample::t_ns);
  return after == samples.begin() ? nullptr : &*(after - 1);
}

/// The captured pose at a time, interpolated. After the last sample it holds, because the body is
/// still there.
inline std::optional<Pose2> pose_at(const PoseTrack& track, std::int64_t t_ns) {
  const PoseSample* const before = held_at(track.samples(), t_ns);
  if (before == nullptr) return std::nullopt;
  if (before == &track.samples().back()) return before->pose;
  const PoseSample& after = before[1];
  return interpolate(
      before->pose, after.pose,
      static_cast<double>(t_ns - before->t_ns) / static_cast<double>(after.t_ns - before->t_ns));
}

/// Sightings with one stamp come from one image.
inline std::vector<std::vector<Sighting>> images_of(const RobotLog& robot) {
  std::vector<std::vector<Sighting>> images;
  for (const Sighting& seen : robot.sightings) {
    if (images.empty() || images.back().back().t_ns != seen.t_ns) images.emplace_back();
    images.back().push_back(seen);
  }
  return images;
}

}  // namespace rave::utias
