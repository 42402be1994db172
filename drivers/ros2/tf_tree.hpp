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

/// The newest transforms between frames, seen from above: each frame has one parent. A value; not
/// for several threads at once.
class TfTree {
 public:
  static constexpr std::size_t kMostFrames = 4096;
  /// No chain is longer; one that is goes round in a circle.
  static constexpr int kLongestChain = 64;

  /// Takes all transforms of a message that passed validate(). Static ones have no time. What leans
  /// matters only to who asks for it. Error kInvalidArgument: more than kMostFrames.
  [[nodiscard]] Status add(const ros2::TfMessage& message, bool is_static);

  struct Found {
    Pose2 X_AB;
    std::int64_t stamp_ns = 0;  ///< Of the newest transform on the way that has a time; 0: none.
  };
  /// Where frame `leaf` (B) is in frame `root` (A), which is above it. Errors: kNotFound says where
  /// the chain ends, kInvalidArgument what leans.
  [[nodiscard]] Result<Found> find(std::string_view root, std::string_view leaf) const;

 private:
  struct Link {
    std::string parent;
    Result<Pose2> X_PC;  ///< Of the child in its parent; or why there is none in the plane.
    std::int64_t stamp_ns = 0;
    bool is_static = false;
  };

  std::map<std::string, Link, std::less<>> links_;  // by child
};

}  // namespace rave::ros2_driver
