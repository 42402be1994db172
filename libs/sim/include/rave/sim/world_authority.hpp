// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "rave/base/hash.hpp"
#include "rave/sim/authority_state.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/host_report.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::sim {

/// The world of a lock-step run with several hosts. It knows the poses of all robots, limits their
/// motion like the engine of a run with one process, and forwards their messages. It runs no driver
/// and no program. Its hash and those of the engines add up to the hash of the run with one
/// process. Belongs to one thread and uses others inside step().
///
/// In each step: Engine::propose() of each host, step() here, Engine::apply() of each host.
class WorldAuthority {
 public:
  /// `spec` as for an Engine; function tables of drivers may be null, `local` is ignored.
  /// `host_of`: for each robot the number of its host; numbers begin at 0 and have no gaps. Errors:
  /// kInvalidArgument.
  [[nodiscard]] static Result<std::unique_ptr<WorldAuthority>> create(
      EngineSpec spec, std::vector<std::uint32_t> host_of);
  WorldAuthority(const WorldAuthority&) = delete;
  WorldAuthority& operator=(const WorldAuthority&) = delete;
  ~WorldAuthority();

  /// Takes one report of each host, in any order, and fills in the next step of the world. Errors:
  /// kInvalidArgument (a report for another step; a robot missing, duplicated or of another host; a
  /// non-finite number), kState (a host is missing or has failed). After an error nothing has
  /// changed, and the call may be repeated.
  Status step(std::span<const HostReport* const> reports, WorldStep& world);

  /// Checks that a report is the one that step() needs next from its host; errors as there.
  [[nodiscard]] Status check(const HostReport& report) const;

  /// The state for the last WorldStep of step(). `with_obstacles`: includes earlier changes of
  /// obstacles, for a process that was not present.
  [[nodiscard]] AuthorityState state(bool with_obstacles = true) const;
  /// Continues in place of another authority with the same spec, after it made `world` and `state`:
  /// the reports of the step after `world` come next. Errors: kInvalidArgument (a world of another
  /// spec); nothing has changed then.
  Status resume(const WorldStep& world, const AuthorityState& state);
  /// Call it after resume() if the changes of the scenario that were due earlier have not been
  /// made; they are then made in the next step.
  void repeat_schedule() noexcept;

  /// Adds an input for robots or obstacles that takes effect with the next step; returns its
  /// number. If it cannot be carried out, refusals() reports it at most two steps later. Errors:
  /// kInvalidArgument (no such robot, nothing to change, a change of the body together with other
  /// parts, those of check_obstacle_change()).
  Result<std::uint64_t> ask(WorldInput input);
  /// Checks that ask() would place a robot as the input says, in the present state. Errors:
  /// kInvalidArgument.
  [[nodiscard]] Status check_place(const WorldInput& input) const;
  /// Adopts an obstacle change that another authority made and numbered. It takes effect with the
  /// next step, even if a robot is in the way. It must have passed check_obstacle_change(), and its
  /// id must be that of an obstacle of world() or the next free one.
  void adopt(ObstacleChange change);

  /// Sets the type (EngineSpec::types) and pose of a robot from the next report of its host on; for
  /// an authority in the process of that host. Errors: kInvalidArgument (no such robot or type).
  Status change_type(RobotId robot, std::uint32_t type, const Pose2& X_WR);

  // For use without step(): an authority over obstacles only, as in a real-time run.

  /// Sets the reported pose of a robot.
  void place(RobotId robot, const Pose2& X_WR, bool present);
  /// Makes a change of an obstacle at once. Returns it with its id, and appends remarks to `note`.
  /// Errors: kInvalidArgument and kNotFound, see ObstacleChange; nothing has changed then.
  Result<ObstacleChange> decide(const ObstacleChange& change, SimTime at, std::string& note);
  /// Continues in place of another authority: `changes` lead from the initial obstacles to the
  /// present ones. Errors: kInvalidArgument; nothing has changed then.
  Status put_obstacles(std::span<const ObstacleChange> changes, SimTime at);

  /// Inputs by hand that hosts or the authority refused in the last step.
  [[nodiscard]] std::span<const InputRefusal> refusals() const noexcept;

  /// The number of scenario changes that failed in all steps, including those of an authority that
  /// this one replaced; and the first AuthorityState::kMostRefused of them, in order.
  [[nodiscard]] std::uint64_t refused_count() const noexcept;
  [[nodiscard]] std::span<const Event> refused() const noexcept;

  /// Restores the state after create().
  void reset();

  [[nodiscard]] const EngineSpec& spec() const noexcept;
  /// The number of completed steps: their motion, contacts and hash are known.
  [[nodiscard]] std::uint64_t steps_done() const noexcept;
  /// The step whose world is made next.
  [[nodiscard]] std::uint64_t next_step() const noexcept;
  /// True pose of a simulated robot, reported pose of a real one, as in the last WorldStep.
  [[nodiscard]] Pose2 pose(RobotId robot) const noexcept;
  /// Contacts, pins, and changes of bodies and obstacles of the last completed step, by robot.
  [[nodiscard]] std::span<const Event> events() const noexcept;
  /// The hash of poses, contacts, pins, and changes of bodies and obstacles in the completed steps.
  [[nodiscard]] RunHash hash() const noexcept;
  /// Makes the report of a lost host for the next step: its simulated robots stand; its real robots
  /// are at their last reported poses, marked as stale. Reuses the memory of `report`.
  void speak_for(std::uint32_t host, HostReport& report) const;
  /// The world as in the last WorldStep.
  [[nodiscard]] const world::Snapshot& snapshot() const noexcept;
  /// All bodies; obstacles as in the last WorldStep.
  [[nodiscard]] const world::WorldModel& world() const noexcept;

 private:
  struct Impl;
  explicit WorldAuthority(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::sim
