// SPDX-License-Identifier: Apache-2.0
#include "ros2/tf_tree.hpp"

#include <algorithm>

#include "rave/bus/sequence.hpp"
#include "rave/math/transform.hpp"
#include "rave/ros2/convert.hpp"

namespace rave::ros2_driver {
// Some nodes still write it.
std::string_view TfTree::frame(const char* text) noexcept {
  std::string_view name(text == nullptr ? "" : text);
  if (name.starts_with('/')) name.remove_prefix(1);
  return name;
}

// Each frame has one parent (REP-105), so the newest transform by child describes the whole tree.
// It keeps no history: a pose may be newer than its stamp by a period of the fastest link.
Status TfTree::add(const ros2::TransformStamped& transform, bool is_static) {
  const std::string_view child = frame(transform.child_frame_id);
  auto found = links_.find(child);
  if (found == links_.end()) {
    // Bounds the memory for a node that invents frame names.
    if (links_.size() >= kMostFrames) {
      return fail(ErrorCode::kInvalidArgument, "more than {} frames", kMostFrames);
    }
    found = links_.emplace(std::string(child), Link{}).first;
  }
  found->second = {std::string(frame(transform.header.frame_id)), ros2::planar(transform),
                   ros2::nanoseconds(transform.header.stamp), is_static};
  return {};
}

bool TfTree::needs(std::string_view child, std::string_view leaf) const noexcept {
  for (int steps = 0; steps < kLongestChain; ++steps) {
    if (leaf == child) return true;
    const auto link = links_.find(leaf);
    if (link == links_.end()) return false;
    leaf = link->second.parent;
  }
  return false;
}

Result<TfTree::Found> TfTree::find(std::string_view root, std::string_view leaf) const {
  Found found;
  bool moves = false;
  std::string_view at = leaf;
  for (int steps = 0; at != root; ++steps) {
    const auto link = links_.find(at);
    if (link == links_.end()) {
      return fail(ErrorCode::kNotFound, "no transform leads from `{}` to `{}`: `{}` has no parent",
                  root, leaf, at);
    }
    // Two nodes that publish contradicting trees can make a cycle.
    if (steps >= kLongestChain) {
      return fail(ErrorCode::kNotFound, "the transforms above `{}` form a cycle", leaf);
    }
    if (!link->second.X_PC) return tl::unexpected(link->second.X_PC.error());
    // From the leaf upwards: each parent is put in front of the product so far.
    found.X_AB = steps == 0 ? *link->second.X_PC : compose(*link->second.X_PC, found.X_AB);
    at = link->second.parent;
    // Static links are true at all times.
    if (link->second.is_static) continue;
    const std::int64_t stamp_ns = link->second.stamp_ns;
    if (stamp_ns == 0) {
      return fail(ErrorCode::kInvalidArgument,
                  "the transform from `{}` to `{}` has no stamp, so its age is unknown", at,
                  link->first);
    }
    // The pose is as old as its oldest link. A localisation repeats its own by a timer, also while
    // the odometry is dead.
    found.stamp_ns = moves ? std::min(found.stamp_ns, stamp_ns) : stamp_ns;
    moves = true;
  }
  if (moves) return found;
  return fail(ErrorCode::kInvalidArgument,
              "all transforms from `{}` to `{}` are static: the pose of a robot changes", root,
              leaf);
}

}  // namespace rave::ros2_driver
