// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"
#include "rave/ros2/messages.hpp"

namespace rave::ros2_driver {

/// The newest transforms between frames, projected to the plane; each frame has one parent. A
/// value; not thread-safe.
class TfTree {
 public:
  static constexpr std::size_t kMostFrames = 4096;
  /// A longer chain is taken for a cycle.
  static constexpr int kLongestChain = 64;

  /// Adds a transform of a message that has passed validate(). Static ones have no time. Tilted
  /// ones are errors only for find() across them. Error kInvalidArgument: more than kMostFrames.
  [[nodiscard]] Status add(const ros2::TransformStamped& transform, bool is_static);
  /// Whether the pose of frame `leaf` depends on the transform to `child`, as far as is known.
  [[nodiscard]] bool needs(std::string_view child, std::string_view leaf) const noexcept;

  /// The name of a frame without the leading slash that it had before tf2.
  [[nodiscard]] static std::string_view frame(const char* text) noexcept;

  struct Found {
    Pose2 X_AB;
    /// Oldest stamp among the transforms of the chain that are not static.
    std::int64_t stamp_ns = 0;
  };
  /// The pose of frame `leaf` (B) in its ancestor `root` (A). Errors: kNotFound says where the
  /// chain ends; kInvalidArgument: a transform is tilted or has no stamp, or all are static.
  [[nodiscard]] Result<Found> find(std::string_view root, std::string_view leaf) const;

 private:
  struct Link {
    std::string parent;
    Result<Pose2> X_PC;  ///< Pose of the child in its parent, or why it has none in the plane.
    std::int64_t stamp_ns = 0;
    bool is_static = false;
  };

  std::map<std::string, Link, std::less<>> links_;  // by child
};

}  // namespace rave::ros2_driver
