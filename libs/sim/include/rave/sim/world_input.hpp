// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/sim/obstacle_change.hpp"
#include "rave/sim/parameter_change.hpp"

namespace rave::sim {

/// Who asks something of a run.
enum class Author : std::uint8_t {
  kRun,   ///< It belongs to the run, as what its scenario says.
  kHand,  ///< Somebody, while it goes: the run is not the scenario's any more.
};

/// Something asked of a run between two steps, of its robots wherever they run or of its obstacles.
struct WorldInput {
  /// kObstacle is the authority's own: it never reaches a host, see WorldStep::obstacles.
  enum class Kind : std::uint8_t { kStop, kRelease, kArm, kChange, kObstacle };
  /// Counts all inputs of a run from 1; given by the WorldAuthority.
  std::uint64_t sequence = 0;
  Kind kind = Kind::kStop;
  Author author = Author::kHand;
  RobotId robot;                           ///< None: all robots; kChange needs one.
  std::vector<ParameterChange> changes;    ///< Of kChange: all of them, or none.
  std::optional<ObstacleChange> obstacle;  ///< Of kObstacle, which needs it.
};

/// Why an input was not carried out.
struct InputRefusal {
  std::uint64_t sequence = 0;  ///< Of the WorldInput.
  std::string text;            ///< For people.
};

}  // namespace rave::sim
