// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <deque>
#include <span>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/topics.hpp"
#include "rave/sim/obstacle_change.hpp"

namespace rave::lock_step {

/// Converts obstacle changes to wire structs, which borrow memory of this object. One owner thread.
class ObstacleParts {
 public:
  /// Valid until the next call. Errors kInvalidArgument: more than the bus can carry, namely too
  /// many changes, a name, colour or text that is too long, or more shapes or corners than the wire
  /// types permit.
  Status fill(std::span<const sim::ObstacleChange> changes);
  [[nodiscard]] std::vector<rave_wire_ObstacleChange>& changes() noexcept { return changes_; }

 private:
  struct Body {
    std::vector<rave_wire_BodyShape> shapes;
    std::vector<double> x_m, y_m;
  };
  Status put_body(const sim::ObstacleChange& change, rave_wire_ObstacleChange& wire);

  std::vector<rave_wire_ObstacleChange> changes_;
  std::deque<Body> bodies_;
};

/// The inverse of fill(), bit by bit. Errors: kInvalidArgument with the field: a polygon that is
/// not convex, not counter-clockwise or has collinear corners, an unknown number. The change must
/// have passed bus::validate().
[[nodiscard]] Result<sim::ObstacleChange> read_obstacle(const rave_wire_ObstacleChange& wire);

/// An upper estimate of the size of a change in a message, in bytes.
[[nodiscard]] std::size_t wire_bytes(const sim::ObstacleChange& change) noexcept;

/// Limit in bytes of all obstacles that differ from their initial state: a process that joins late
/// gets them in one message, of which the bus carries 16 MiB.
inline constexpr std::size_t kMostObstacleBytes = 8U << 20U;

/// Checks that the bus can carry a change without loss. Errors: kInvalidArgument.
[[nodiscard]] Status check_fits(const sim::ObstacleChange& change);

}  // namespace rave::lock_step
