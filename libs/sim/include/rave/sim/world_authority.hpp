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

/// Holds a world whose robots run on several hosts in lock-step: knows where all robots are, limits
/// their motion as the engine of a one-process run does, and passes on what they send. It runs no
/// driver and no program. The hashes of the authority and of all engines that take part add up to
/// that of the one-process run. Belongs to one thread; uses others inside step().
///
/// For each step: Engine::propose() of each host, step() here, Engine::apply() of each host.
class WorldAuthority {
 public:
  /// `spec` as for an Engine; function tables of drivers may be null, `local` is not looked at.
  /// `host_of` says for each robot the number of the host that runs it, from 0 without gaps.
  /// Errors: kInvalidArgument.
  [[nodiscard]] static Result<std::unique_ptr<WorldAuthority>> create(
      EngineSpec spec, std::vector<std::uint32_t> host_of);
  WorldAuthority(const WorldAuthority&) = delete;
  WorldAuthority& operator=(const WorldAuthority&) = delete;
  ~WorldAuthority();

  /// Takes one report of each host, in any order, and fills in the next step of the world.
  /// Errors: kInvalidArgument (a report that is not what this step needs: another step, a robot
  /// missing, twice or of another host, a number that is none), kState (a host is missing or has
  /// failed). After an error nothing has changed, and it may be tried again.
  Status step(std::span<const HostReport* const> reports, WorldStep& world);

  /// Whether a report is what step() needs next of its host; errors as there.
  [[nodiscard]] Status check(const HostReport& report) const;

  /// What belongs to the WorldStep that step() made last. `with_obstacles`: also those of before,
  /// which only somebody needs who was not there.
  [[nodiscard]] AuthorityState state(bool with_obstacles = true) const;
  /// Goes on in the place of another authority of the same spec, after it had made `world` and
  /// `state`: the reports of the step after `world` come next. Errors: kInvalidArgument (a world of
  /// another spec); then nothing has changed.
  Status resume(const WorldStep& world, const AuthorityState& state);
  /// After resume(): what the scenario had to change before is made with the next step, for nobody
  /// else has made it.
  void repeat_schedule() noexcept;

  /// Asks something of robots or obstacles, from the next step on; returns its number. That it
  /// cannot be done is known two steps later at the latest, see refusals(). Errors:
  /// kInvalidArgument (no such robot, nothing to change, a change of the body together with other
  /// parts, what check_obstacle_change() says).
  Result<std::uint64_t> ask(WorldInput input);
  /// Whether ask() would put a robot where the input says, as things stand now. Errors:
  /// kInvalidArgument.
  [[nodiscard]] Status check_place(const WorldInput& input) const;
  /// A change of an obstacle that another authority has made, and given its number: it counts from
  /// the next step on, whoever stands there. It has passed check_obstacle_change(), and its number
  /// is that of an obstacle of world(), or the one that comes next.
  void adopt(ObstacleChange change);

  /// A robot has the drivers of another type (EngineSpec::types) from the next report of its host
  /// on, and is there; for an authority in the process of that host. Errors: kInvalidArgument (no
  /// such robot or type).
  Status change_type(RobotId robot, std::uint32_t type, const Pose2& X_WR);

  // Where nobody calls step(): an authority over obstacles alone, as a run in real time has one.

  /// Where a robot is said to be.
  void place(RobotId robot, const Pose2& X_WR, bool present);
  /// Makes a change of an obstacle at once; returns it with its number, and appends to `note` what
  /// is worth telling. Errors: kInvalidArgument and kNotFound, see ObstacleChange; then everything
  /// is as it was.
  Result<ObstacleChange> decide(const ObstacleChange& change, SimTime at, std::string& note);
  /// Goes on in the place of another one: `changes` lead from the obstacles of the start to those
  /// that there are. Errors: kInvalidArgument; then nothing has changed.
  Status put_obstacles(std::span<const ObstacleChange> changes, SimTime at);

  /// What hosts and authority said in the last step to inputs that came by hand.
  [[nodiscard]] std::span<const InputRefusal> refusals() const noexcept;

  /// How many changes of the scenario could not be made in all steps, also by an authority in whose
  /// place this one goes on; and the first AuthorityState::kMostRefused of them, in order.
  [[nodiscard]] std::uint64_t refused_count() const noexcept;
  [[nodiscard]] std::span<const Event> refused() const noexcept;

  /// Back to the state after create().
  void reset();

  [[nodiscard]] const EngineSpec& spec() const noexcept;
  /// Of which all is known: motion, contacts, hash.
  [[nodiscard]] std::uint64_t steps_done() const noexcept;
  /// The world of this one is made next.
  [[nodiscard]] std::uint64_t next_step() const noexcept;
  /// True pose of a simulated, reported pose of a real robot, as the last WorldStep shows it.
  [[nodiscard]] Pose2 pose(RobotId robot) const noexcept;
  /// Contacts, pins, changes of bodies and obstacles of the last step that is done, by robot.
  [[nodiscard]] std::span<const Event> events() const noexcept;
  /// Of poses, contacts, pins, changes of bodies and obstacles in the steps that are done.
  [[nodiscard]] RunHash hash() const noexcept;
  [[nodiscard]] std::uint32_t host_count() const noexcept;
  /// The report of a host that is gone: of the next step, its simulated robots want to stand, its
  /// real ones are where they were last reported, which is old by now. `report` keeps its memory.
  void speak_for(std::uint32_t host, HostReport& report) const;
  /// The world as the last WorldStep shows it.
  [[nodiscard]] const world::Snapshot& snapshot() const noexcept;
  /// All bodies; obstacles as the last WorldStep shows them.
  [[nodiscard]] const world::WorldModel& world() const noexcept;

 private:
  struct Impl;
  explicit WorldAuthority(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::sim
