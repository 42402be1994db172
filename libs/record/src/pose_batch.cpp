// SPDX-License-Identifier: Apache-2.0
// Poses of a step, packed. A true pose is stored only where it differs from the reported one.
#include "pose_batch.hpp"

#include <bit>
#include <cstdint>

namespace rave::record {
namespace {

/// Compares bits instead of values: -0 differs from 0, and a NaN equals itself.
[[nodiscard]] bool same_bits(const Pose2& a, const Pose2& b) noexcept {
  using Words = std::array<std::uint64_t, 3>;
  return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}

}  // namespace

void PoseBatch::add(const RobotPose& robot) {
  PackedPose& packed = poses_.emplace_back();
  packed = {robot.robot.value(), 0, 0, 0, 0, robot.velocity_W.vx, robot.velocity_W.vy,
            robot.velocity_W.wz};
  if (robot.reported_pose) {
    packed.flags |= kHasReported;
    packed.x = robot.reported_pose->x;
    packed.y = robot.reported_pose->y;
    packed.yaw = robot.reported_pose->yaw;
  }
  if (!robot.true_pose) return;
  packed.flags |= kHasTrue;
  // Of most robots both poses are equal; the second one is then not stored.
  if (robot.reported_pose && same_bits(*robot.true_pose, *robot.reported_pose)) {
    packed.flags |= kTrueIsReported;
  } else {
    const Pose2& X_WR = *robot.true_pose;
    truths_.push_back({robot.robot.value(), 0, X_WR.x, X_WR.y, X_WR.yaw});
  }
}

void PoseBatch::add(const PoseBlock& block) {
  // Simulated robots without a pose source, whose reported pose is the true one.
  const std::size_t before = poses_.size();
  poses_.resize(before + block.robots);
  PackedPose* const packed = poses_.data() + before;
  for (std::uint32_t i = 0; i < block.robots; ++i) {
    const Pose2& X_WR = at(block.X_WR, block.stride_bytes, i);
    const Twist2& velocity_W = at(block.velocity_W, block.stride_bytes, i);
    packed[i] = {block.first.value() + i,
                 kHasReported | kHasTrue | kTrueIsReported,
                 X_WR.x,
                 X_WR.y,
                 X_WR.yaw,
                 velocity_W.vx,
                 velocity_W.vy,
                 velocity_W.wz};
  }
}

Status PoseBatch::write(McapWriter& file, CdrWriter& cdr, SimTime time, std::uint64_t step) {
  if (poses_.empty()) return {};
  encode_step_head(cdr, time, step, poses_.size());
  // A reserved word aligns the array of true poses to 8.
  const std::array<std::uint32_t, 2> between{0, static_cast<std::uint32_t>(truths_.size())};
  const std::array<std::span<const std::byte>, 4> parts{
      cdr.bytes(), std::as_bytes(std::span(poses_)), std::as_bytes(std::span(between)),
      std::as_bytes(std::span(truths_))};
  Status status = stream.write(file, time, parts);
  poses_.clear();
  truths_.clear();
  return status;
}

}  // namespace rave::record
