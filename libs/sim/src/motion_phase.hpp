// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "near_lists.hpp"
#include "rave/sim/thread_pool.hpp"
#include "rave/world/snapshot.hpp"
#include "resolver.hpp"

namespace rave::sim {

/// The robots of a step, one entry per robot in each array. Real robots are left as they are.
struct MotionArrays {
  std::span<Mover> movers;           ///< In: as the snapshot shows them. Out: where the step led.
  std::span<const Twist2> proposal;  ///< Body frame; finite.
  std::span<Twist2> velocity;        ///< Out: body frame, what the proposal became.
  std::span<std::uint8_t> limited;   ///< Out: 1 if something was in the way.
  std::span<TouchState> touch;       ///< Out: nothing is touched; the notes say more.
};

/// The resolve phase of a step. A broad phase that runs on all threads finds the robots that can
/// meet nothing, whatever the others do, and moves them at once; the rest goes through the
/// resolver, one after the other in the order of their ids. The result is to the bit that of the
/// resolver alone, for any number of threads; docs/explanation/motion.md shows why. Belongs to one
/// thread.
class MotionPhase {
 public:
  /// Keeps references to both, which must outlive it.
  MotionPhase(Resolver& resolver, ThreadPool& pool) : resolver_(&resolver), pool_(&pool) {}

  /// Moves each simulated robot by its proposal for `dt_s` seconds (> 0) as far as it can go.
  /// `notes` is filled with what was met; its former content is dropped. No allocation once the
  /// number of robots and of notes has been seen.
  void run(const world::Snapshot& snapshot, double dt_s, const MotionArrays& robots,
           std::vector<ContactNote>& notes);

  /// Of the last run: how far a robot may have moved since the snapshot, metres.
  [[nodiscard]] double slack_m() const noexcept { return slack_m_; }
  /// Of the last run: how many robots the broad phase could not let go.
  [[nodiscard]] std::size_t resolved() const noexcept { return resolved_; }
  /// Of the last run: for how many blocks of robots lists of earlier runs were used.
  [[nodiscard]] std::size_t kept_lists() const noexcept {
    return static_cast<std::size_t>(std::count(kept_.begin(), kept_.end(), 1));
  }

 private:
  struct Step {
    const world::Snapshot& snapshot;
    double dt_s;
    MotionArrays robots;
  };
  /// What became of a robot in the broad phase.
  enum Way : std::uint8_t { kStands, kAhead = Resolver::kAhead, kToResolve };

  void measure(const Step& step, std::size_t block);
  void let_go(const Step& step, std::size_t block);
  /// What the robots of a block have near; null if lists do not pay.
  [[nodiscard]] const NearLists* find_near(const Step& step, std::size_t block);
  /// Lets it go or stand, if it may. `lists`: of its block, or null.
  [[nodiscard]] Way try_to_go(const Step& step, std::uint32_t robot, const NearLists* lists) const;
  /// Whether nothing can be met, by what the grids of the snapshot or the lists say is near.
  [[nodiscard]] bool is_free(const Step& step, std::uint32_t robot) const;
  [[nodiscard]] bool is_free(const Step& step, std::uint32_t robot, const NearLists& lists) const;
  [[nodiscard]] bool may_meet(const Step& step, std::uint32_t robot, std::uint32_t other) const;
  /// Farther off than this from where its origin is, nothing that stands and no piece of a robot
  /// has to be looked at.
  [[nodiscard]] double standing_reach_m(const Step& step, std::uint32_t robot) const;
  [[nodiscard]] double look_m(double reach_m) const noexcept;
  void resolve(const Step& step, std::uint32_t robot, std::vector<ContactNote>& notes);

  Resolver* resolver_;
  ThreadPool* pool_;
  ThreadPool::Effort measure_effort_, let_go_effort_;
  std::vector<double> reach_m_;  ///< Per robot: it stays this near to where its origin was.
  std::vector<double> block_slack_m_;
  std::vector<std::uint8_t> way_;       ///< Per robot.
  std::vector<NearLists> near_;         ///< Per block.
  std::vector<std::uint8_t> kept_;      ///< Per block: its lists are of an earlier run.
  std::vector<double> listed_slack_m_;  ///< Per block: slack_m_ when its lists were made.
  MotionWatch watch_;
  double moves_m_ = 0;  ///< What a robot may move by until the next run, as far as one can tell.
  double slack_m_ = 0;
  std::size_t resolved_ = 0;
};

}  // namespace rave::sim
