// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "rave/gui_server/source.hpp"

// Binary frames of the stream; docs/reference/gui-frames.md describes them.
namespace rave::gui_server {

struct PoseFrameHead {
  std::uint32_t sequence = 0;
  bool past = false;
  bool truth = false;
};

/// Of the true poses if `head` says so.
[[nodiscard]] std::string encode_poses(const PosesAt& poses, const PoseFrameHead& head);

/// `time_s`: of the picture that the reading belongs to.
[[nodiscard]] std::string encode_reading(const ReadingAt& reading, double time_s,
                                         bool past = false);

/// A tile of the map that a page knows by `name`; `map` holds the tile.
[[nodiscard]] std::string encode_tile(const MapName& name, const MapShown& map, std::uint32_t row,
                                      std::uint32_t column);

/// How sure a robot is of its reported pose.
struct VarianceAt {
  std::uint32_t slot = 0;
  float xy_m2 = 0;  ///< Of each of x and y.
  float yaw_rad2 = 0;
  friend bool operator==(const VarianceAt&, const VarianceAt&) = default;
};
[[nodiscard]] std::string encode_variances(std::span<const VarianceAt> variances, double time_s);

}  // namespace rave::gui_server
