// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rave/world/snapshot.hpp"
#include "rave/world/touching.hpp"

namespace rave::sim {

/// A body as the resolver moves it.
struct Mover {
  Pose2 X_WR;
  bool simulated = true;  ///< Real robots are never moved.
  bool present = true;
};

/// What stopped or touched a robot.
struct ContactNote {
  std::uint32_t robot = 0;
  BodyId other;
  Vec2 direction_W;  ///< From the robot towards the other.
  bool pinned = false;
};

/// The world authority's last word on motion: robots are moved one after the other, in the order of
/// their ids, each as far as it can go without coming nearer than the skin to anything that stands,
/// then along what stopped it. So overlap is never created and nothing is passed through. One
/// thread; the result depends on nothing but its input.
class Resolver {
 public:
  explicit Resolver(const world::WorldModel& model);

  /// Moves robot `id` from movers[id] by `motion_W`. `snapshot` is the broad phase: poses in it may
  /// be up to `slack_m` away from those in `movers`. Robots that were moved before it was their
  /// turn are marked kAhead in `ahead` (one entry per robot, or none at all): until then they count
  /// where the snapshot shows them.
  void move(std::uint32_t id, const Motion2& motion_W, const world::Snapshot& snapshot,
            double slack_m, std::span<Mover> movers, std::vector<ContactNote>& notes,
            std::span<const std::uint8_t> ahead = {});
  static constexpr std::uint8_t kAhead = 1;

  /// Pushes simulated robots out of the real robot `id`, which has just come to its place; one that
  /// cannot get away is noted as pinned. Returns how far the farthest was pushed: by so much more
  /// `snapshot` is behind from now on.
  double make_way(std::uint32_t id, const world::Snapshot& snapshot, double slack_m,
                  std::span<Mover> movers, std::vector<ContactNote>& notes);

  /// What robot `id` touches or overlaps (nearer than `within_m`) of `layers`; the nearest one is
  /// noted.
  void probe(std::uint32_t id, const world::Snapshot& snapshot, double slack_m, double within_m,
             std::span<const Mover> movers, std::vector<ContactNote>& notes,
             LayerMask layers = kAllLayers);

  /// Robot `id` has another body from now on, as the model says.
  void body_changed(std::uint32_t id);

  /// Of the robot's body about its origin.
  [[nodiscard]] double radius_m(std::uint32_t id) const noexcept {
    return radius_m_[model_->obstacles.size() + id];
  }
  [[nodiscard]] std::uint32_t obstacle_count() const noexcept {
    return static_cast<std::uint32_t>(model_->obstacles.size());
  }

  /// move() looks for what its snapshot shows nearer than this to where the body may get.
  static constexpr double kLookAround_m = 1e-3;
  /// It passes over another robot if the two cannot get nearer to each other than this.
  static constexpr double kPassOver_m = ImpactLimits{}.skin_m + 1e-6;

 private:
  void find_near(std::uint32_t id, Vec2 p_W, double reach_m, const world::Snapshot& snapshot);
  /// Moves until something stops it; true if something did, which is then described in `impact_`
  /// and `obstacle_`.
  bool advance_until_hit(std::uint32_t id, const Motion2& motion, std::span<Mover> movers);
  /// Of obstacles as the snapshot shows them, which may be one of the past.
  [[nodiscard]] Pose2 pose_of(std::uint32_t body, const world::Snapshot& snapshot,
                              std::span<const Mover> movers) const;
  /// The same while robot `id` moves.
  [[nodiscard]] Pose2 pose_in_turn(std::uint32_t body, std::uint32_t id,
                                   std::span<const Mover> movers) const;
  bool push_out(std::uint32_t real, std::uint32_t id, std::span<Mover> movers);

  const world::WorldModel* model_;
  std::vector<double> radius_m_;  ///< Per body of the start, about its origin.
  std::vector<std::uint32_t> found_;
  std::vector<std::uint32_t> near_;   ///< Bodies that may be met.
  std::vector<std::uint32_t> crowd_;  ///< Simulated robots near a real one.
  std::uint32_t ignored_ = BodyId::kNone;
  Impact impact_;
  std::uint32_t obstacle_ = 0;
  std::span<const std::uint8_t> ahead_;        ///< During move() alone.
  const world::Snapshot* snapshot_ = nullptr;  ///< During move() and make_way().
};

}  // namespace rave::sim
