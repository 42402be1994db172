// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"
#include "rave/sim/event.hpp"
#include "rave/sim/world_input.hpp"

namespace rave::sim {

struct EngineSpec;

/// What conditions and scripts of a scenario see: the world as the last step left it, before
/// anything of the step that comes is done. Poses X_WR in the world frame, the true ones of
/// simulated and the reported ones of real robots. Valid during the call that it is passed to.
class WorldLook {
 public:
  virtual ~WorldLook() = default;
  /// With robots, types and obstacles as they are now.
  [[nodiscard]] virtual const EngineSpec& spec() const = 0;
  [[nodiscard]] virtual SimTime now() const = 0;  ///< The time of the step that comes.
  [[nodiscard]] virtual std::uint64_t step() const = 0;
  /// Empty: the robot is not in the world now.
  [[nodiscard]] virtual std::optional<Pose2> pose(RobotId robot) const = 0;
  /// The magnitude of the velocity in the last step [m/s].
  [[nodiscard]] virtual double speed_mps(RobotId robot) const = 0;
  /// Whether the robot touches something.
  [[nodiscard]] virtual bool touches(RobotId robot) const = 0;
  /// The pose X_WB of the obstacle with this name; empty: there is none now.
  [[nodiscard]] virtual std::optional<Pose2> obstacle(std::string_view name) const = 0;
};

/// An event of a scenario: of which kind, EventKind::kScenario or kTeamGiven, and its text.
struct ScenarioNote {
  EventKind kind = EventKind::kScenario;
  std::string text;
};

/// What a conductor decides for one step.
struct Conducted {
  std::vector<WorldInput> inputs;  ///< Made in this order, with Author::kRun.
  std::vector<ScenarioNote> notes;

  void clear() {
    inputs.clear();
    notes.clear();
  }
};

/// Decides, once a step, what happens in a run because of what has happened: the conditions and
/// scripts of its scenario. An engine that is alone asks it, or the authority of several
/// hosts. The same world gives the same decisions, in any process.
class Conductor {
 public:
  virtual ~Conductor() = default;
  /// A run begins.
  virtual void begin() = 0;
  /// Fills `conducted`, which is empty. Called once a step, until ended().
  virtual void decide(const WorldLook& world, Conducted& conducted) = 0;
  /// Whether the step that it decided last is the last one of the run.
  [[nodiscard]] virtual bool ended() const noexcept = 0;
  /// Why the run that it has ended is a failure; empty: it is none.
  [[nodiscard]] virtual std::optional<std::string> failure() const = 0;
  /// What it needs of the past in order to continue in another process; at most kMostState bytes.
  [[nodiscard]] virtual std::vector<std::byte> state() const = 0;
  /// Continues from state(). Error kParse: not the state of this scenario.
  [[nodiscard]] virtual Status resume(std::span<const std::byte> state) = 0;

  static constexpr std::size_t kMostState = std::size_t{128} << 10U;
};

}  // namespace rave::sim
