// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <span>
#include <vector>

#include "motion_phase.hpp"
#include "obstacle_journal.hpp"
#include "rave/base/hash.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/obstacle_change.hpp"
#include "rave/sim/thread_pool.hpp"
#include "resolver.hpp"

namespace rave::sim {

/// What holds for all robots of a world at once: where they are, how they move, what they touch,
/// how large they are, and the snapshot that shows it. The authority of a world calls
/// all phases, in the order in which they stand here: an Engine that is alone, or a WorldAuthority.
/// An Engine with a part of the robots fills in what its authority says, and calls show() alone.
/// Vectors are by robot. Belongs to one thread; uses the pool inside its phases.
struct WorldTruth {
  /// Keeps references to both, which must outlive it. Bodies in `spec` change with resize(), its
  /// obstacles with change_obstacle().
  WorldTruth(EngineSpec& spec, ThreadPool& pool);
  WorldTruth(const WorldTruth&) = delete;
  WorldTruth& operator=(const WorldTruth&) = delete;

  /// All robots at their poses in the spec, none moving.
  void begin();

  /// Pushes simulated robots out of the real ones, which have just been put in their places, and
  /// notes whom. Real robots are never moved.
  void make_way();
  /// What is touched at these places; contacts and pins that begin become events of `step`.
  void note_contacts(std::uint64_t step, std::vector<Event>& events);
  /// The snapshot shows `movers`, `velocity` and `touch` from now on.
  void show(SimTime now);
  /// Moves simulated robots by their proposals, as far as they can go.
  void resolve(std::uint64_t step, std::vector<Event>& events);
  /// Of the poses, velocities and contacts of who is present.
  [[nodiscard]] RunHash hash_poses(std::uint64_t step);

  /// Takes over what another authority knew after show(): poses, velocities and touches stand in
  /// `movers`, `velocity` and `touch` already.
  void take_over(SimTime now, std::span<const RobotId> pinned);
  /// Where robots are and how they move, as another process has decided.
  void adopt_robots(const WorldStep& world);
  /// Who was pushed elsewhere then, and who touches what.
  void adopt_contacts(const WorldStep& world);
  /// Who could not get out of a real robot's way; ascending.
  [[nodiscard]] std::vector<RobotId> pinned() const;
  /// All robots whose bodies have another size than the spec says; ascending.
  [[nodiscard]] const std::map<std::uint32_t, double>& scales() const noexcept { return scales_; }

  /// Changes the size of a simulated robot; between resolve() and make_way(). Errors:
  /// kInvalidArgument (a real robot, a scale that no body can have, it would overlap something);
  /// then everything is as it was.
  Status resize(RobotId robot, double scale);
  /// The same without a check for overlaps: another process has checked.
  Status put_scale(RobotId robot, double scale);
  [[nodiscard]] double scale_of(RobotId robot) const;
  /// A robot is from now on a simulated or a real one, and stands there; between resolve() and
  /// make_way().
  void set_reality(RobotId robot, bool simulated, const Pose2& X_WR);
  /// Puts a simulated robot elsewhere, where it stands; between resolve() and make_way(). Errors:
  /// kInvalidArgument (a real robot, it would overlap something); then everything is as it was.
  Status place(RobotId robot, const Pose2& X_WR);
  /// Whether that could be done now.
  [[nodiscard]] Status check_place(RobotId robot, const Pose2& X_WR) const;
  /// Gives all robots back the bodies that they had, and returns whose changed.
  [[nodiscard]] std::vector<RobotId> restore_bodies();

  /// Adds, moves or removes an obstacle, which counts from the time `from` on; between resolve()
  /// and make_way(). Returns the change with id and name, and appends to `note` what is worth
  /// telling. Errors: kInvalidArgument (what check_obstacle_change() says, a name that is taken,
  /// too many, it would overlap a simulated robot), kNotFound; then everything is as it was.
  Result<ObstacleChange> change_obstacle(ObstacleChange change, SimTime from, std::string& note);
  /// The same of many, one after the other, without a check for overlaps: another process has
  /// checked, and given the ids. `placed`, which may be empty, is called after each.
  void put_obstacles(std::span<const ObstacleChange> changes, SimTime from,
                     const std::function<void(const ObstacleChange&)>& placed = {});
  /// Puts the obstacles of the start back, and forgets all others; false if nothing had changed.
  bool restore_obstacles();

  /// Nearer than this two bodies touch: the skin that the resolver keeps.
  static constexpr double kApart_m = 1e-4;

  /// Robots in the order of their ids, by blocks, whatever their groups.
  static constexpr std::size_t kRobotBlock = 256;
  [[nodiscard]] std::size_t robot_blocks() const noexcept {
    return (movers.size() + kRobotBlock - 1) / kRobotBlock;
  }
  [[nodiscard]] std::uint32_t first_of_block(std::size_t block) const noexcept {
    return static_cast<std::uint32_t>(std::min(block * kRobotBlock, movers.size()));
  }

  EngineSpec& spec;
  ThreadPool& pool;
  world::Snapshot snapshot;
  Resolver resolver;
  MotionPhase motion{resolver, pool};
  std::vector<Mover> movers;          ///< True poses of simulated, reported poses of real robots.
  std::vector<Twist2> velocity;       ///< Body frame, of the last step.
  std::vector<Twist2> proposal;       ///< Body frame; finite.
  std::vector<std::uint8_t> limited;  ///< The last motion was cut short.
  std::vector<TouchState> touch;
  std::vector<ContactNote> notes;  ///< Of the last phase.
  std::vector<double> radius_m;    ///< Of each robot's body about its origin.
  ObstacleJournal journal;

 private:
  double place_block(std::uint32_t first, std::uint32_t last);
  void find_real();
  void hash_block(std::uint64_t step, std::uint32_t first, std::uint32_t last, RunHash& sum) const;
  void put_body(RobotId robot, const world::Body& body);
  [[nodiscard]] Result<world::Body> body_at(RobotId robot, double scale) const;
  Status check_room(RobotId robot, const world::Body& body, double scale) const;
  void place_obstacle(const ObstacleChange& change, SimTime from);
  [[nodiscard]] Result<BodyId> find_obstacle(const ObstacleChange& change) const;
  Status check_new_obstacle(const ObstacleChange& change) const;
  Status check_room_for(const ObstacleChange& change, const world::Body& body,
                        std::string& note) const;

  std::vector<std::uint32_t> real_;  ///< Robots that are not simulated; ascending.
  std::vector<std::uint8_t> touching_before_;
  std::vector<std::uint8_t> pinned_before_;
  double slack_m_ = 0;  ///< How far robots may have moved since the snapshot.
  std::vector<double> block_moves_m_;
  std::vector<RunHash> block_hash_;
  ThreadPool::Effort place_effort_, hash_effort_;
  std::map<std::uint32_t, world::Body> original_bodies_;  ///< Of robots that were resized.
  std::map<std::uint32_t, double> scales_;                ///< Of the same.
  std::map<std::uint32_t, Pose2> original_places_;        ///< Of obstacles that have changed.
};

/// Sorts the events of a step, so that their order of arrival does not matter, and hashes them.
void finish_events(std::uint64_t step, std::vector<Event>& events, RunHash& hash);

}  // namespace rave::sim
