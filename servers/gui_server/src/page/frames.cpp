// SPDX-License-Identifier: Apache-2.0
#include "page/frames.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

namespace rave::gui_server {
namespace {

static_assert(std::endian::native == std::endian::little, "frames are written little-endian");

constexpr std::size_t kPoseHeader = 48;
constexpr std::size_t kReadingHeader = 32;
/// In the byte of the part.
constexpr unsigned kPastReading = 0x80;
constexpr std::size_t kVarianceHeader = 16;
constexpr std::size_t kVarianceBytes = 12;
constexpr std::size_t kTileHeader = 64;
constexpr double kFinest_m = 1e-4;

template <class T>
void put(std::string& frame, std::size_t offset, T value) {
  std::memcpy(frame.data() + offset, &value, sizeof value);
}

/// The quantum with which everybody fits: the finest, or a power of two of it.
double quantum_for(std::span<const RobotState> robots, double origin_x, double origin_y) {
  double farthest = 0;
  for (const RobotState& robot : robots) {
    if ((robot.flags & kKnown) == 0) continue;
    farthest = std::max({farthest, std::abs(robot.x_m - origin_x), std::abs(robot.y_m - origin_y)});
  }
  double quantum = kFinest_m;
  // Half of the range, so that rounding cannot leave it.
  constexpr double kMost = std::numeric_limits<std::int32_t>::max() / 2.0;
  while (farthest / quantum > kMost) quantum *= 2;
  return quantum;
}

std::int32_t quantised(double value, double quantum) {
  return static_cast<std::int32_t>(std::lround(value / quantum));
}

std::uint16_t turn_of(double yaw_rad) {
  const double turns = yaw_rad / (2 * std::numbers::pi);
  // Just below a whole turn rounds to 65536, which is 0 again.
  return static_cast<std::uint16_t>(std::lround((turns - std::floor(turns)) * 65536) & 0xffff);
}

std::int16_t speed_of(double speed_mps) {
  // Clamped: a robot faster than 32.767 m/s shows that speed instead of a negative one.
  return static_cast<std::int16_t>(std::clamp(std::round(1000 * speed_mps), -32767.0, 32767.0));
}

}  // namespace

std::string encode_poses(const PosesAt& poses, const PoseFrameHead& head) {
  const std::span<const RobotState> robots = head.truth ? poses.truth : poses.robots;
  const std::size_t n = robots.size();
  // For each robot 14 bytes: x and y (4 each), yaw, speed and flags (2 each).
  // docs/reference/gui-frames.md has the layout.
  std::string frame(kPoseHeader + 14 * n, '\0');
  // A world far from the origin keeps its resolution if frames count from one of its robots.
  double origin_x = 0;
  double origin_y = 0;
  for (const RobotState& robot : robots) {
    if ((robot.flags & kKnown) == 0) continue;
    if (std::max(std::abs(robot.x_m), std::abs(robot.y_m)) > 1e5) {
      origin_x = std::round(robot.x_m);
      origin_y = std::round(robot.y_m);
    }
    break;
  }
  // As float, because the frame has four bytes for it: positions are divided by exactly the number
  // that the page multiplies with.
  const auto quantum = static_cast<float>(quantum_for(robots, origin_x, origin_y));
  put(frame, 0, std::uint8_t{1});
  put(frame, 1, static_cast<std::uint8_t>((head.past ? 1 : 0) | (head.truth ? 2 : 0)));
  put(frame, 4, head.sequence);
  put(frame, 8, poses.time_s);
  put(frame, 16, static_cast<std::uint32_t>(poses.step));
  put(frame, 20, static_cast<std::uint32_t>(n));
  put(frame, 24, origin_x);
  put(frame, 32, origin_y);
  put(frame, 40, quantum);
  put(frame, 44, poses.taken_us);
  for (std::size_t i = 0; i < n; ++i) {
    const RobotState& robot = robots[i];
    const bool known = (robot.flags & kKnown) != 0;
    // Column by column: the page reads each as one typed array of its buffer.
    const std::size_t x = kPoseHeader + 4 * i;
    const std::size_t yaw = kPoseHeader + 8 * n + 2 * i;
    put(frame, x, known ? quantised(robot.x_m - origin_x, quantum) : 0);
    put(frame, x + 4 * n, known ? quantised(robot.y_m - origin_y, quantum) : 0);
    put(frame, yaw, known ? turn_of(robot.yaw_rad) : std::uint16_t{0});
    put(frame, yaw + 2 * n, known ? speed_of(robot.speed_mps) : std::int16_t{0});
    put(frame, yaw + 4 * n, robot.flags);
  }
  return frame;
}

std::string encode_reading(const ReadingAt& reading, double time_s, bool past) {
  std::string frame(kReadingHeader + 4 * reading.values.size(), '\0');
  put(frame, 0, std::uint8_t{2});
  put(frame, 1, static_cast<std::uint8_t>(reading.part | (past ? kPastReading : 0U)));
  put(frame, 2, static_cast<std::uint16_t>(reading.sensor));
  put(frame, 4, reading.slot);
  put(frame, 8, reading.stamp_s);
  put(frame, 16, time_s);
  put(frame, 24, reading.rows);
  put(frame, 28, reading.fields);
  if (!reading.values.empty()) {
    std::memcpy(frame.data() + kReadingHeader, reading.values.data(), 4 * reading.values.size());
  }
  return frame;
}

std::string encode_tile(const MapName& name, const MapShown& map, std::uint32_t row,
                        std::uint32_t column) {
  const TileShown& tile = map.tiles.at({row, column});
  const std::string_view title = name.global() ? std::string_view(name.name) : std::string_view();
  std::string frame(kTileHeader + tile.cells.size() + title.size(), '\0');
  put(frame, 0, std::uint8_t{4});
  put(frame, 2, static_cast<std::uint16_t>(title.size()));
  put(frame, 4, name.slot);
  put(frame, 8, tile.stamp.seconds());
  put(frame, 16, map.frame.origin_W.x);
  put(frame, 24, map.frame.origin_W.y);
  put(frame, 32, map.frame.resolution_m);
  put(frame, 40, map.frame.columns);
  put(frame, 44, map.frame.rows);
  put(frame, 48, column);
  put(frame, 52, row);
  put(frame, 56, maps::MapFrame::side(map.frame.columns, column));
  put(frame, 60, maps::MapFrame::side(map.frame.rows, row));
  std::copy(tile.cells.begin(), tile.cells.end(), frame.begin() + kTileHeader);
  std::copy(title.begin(), title.end(),
            frame.begin() + static_cast<std::ptrdiff_t>(kTileHeader + tile.cells.size()));
  return frame;
}

std::string encode_variances(std::span<const VarianceAt> variances, double time_s) {
  std::string frame(kVarianceHeader + kVarianceBytes * variances.size(), '\0');
  put(frame, 0, std::uint8_t{3});
  put(frame, 4, static_cast<std::uint32_t>(variances.size()));
  put(frame, 8, time_s);
  std::size_t offset = kVarianceHeader;
  for (const VarianceAt& variance : variances) {
    put(frame, offset, variance.slot);
    put(frame, offset + 4, variance.xy_m2);
    put(frame, offset + 8, variance.yaw_rad2);
    offset += kVarianceBytes;
  }
  return frame;
}

}  // namespace rave::gui_server
