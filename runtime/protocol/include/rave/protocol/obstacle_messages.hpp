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

/// Changes of obstacles, in memory that a bus message borrows. One owner thread.
class ObstacleParts {
 public:
  /// Holds until the next call. Errors: kInvalidArgument, what the bus cannot carry: too many, a
  /// name, colour or text that is too long, more shapes or corners than the wire types allow.
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

/// And back, to the bit. Errors: kInvalidArgument with the field: a polygon that is not convex, not
/// counterclockwise or has corners on one line, an unknown number. The change has passed
/// bus::validate().
[[nodiscard]] Result<sim::ObstacleChange> read_obstacle(const rave_wire_ObstacleChange& wire);

/// How many bytes of a message a change takes, roughly and rather more than less.
[[nodiscard]] std::size_t wire_bytes(const sim::ObstacleChange& change) noexcept;

/// Most bytes of all obstacles that are not as at the start: whoever comes late is told of them in
/// one message, of which the bus carries 16 MiB.
inline constexpr std::size_t kMostObstacleBytes = 8U << 20U;

/// Whether the bus can carry a change, and others would read the same. Errors: kInvalidArgument.
[[nodiscard]] Status check_fits(const sim::ObstacleChange& change);

}  // namespace rave::lock_step
