// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "rave/world/snapshot.hpp"

namespace rave::sim {

/// How far things move from one use of a world to the next.
class MotionWatch {
 public:
  /// What no piece of a robot has moved farther than since the last call, in metres; infinite at
  /// the first call, and if a robot has jumped since.
  double look(const world::Snapshot& world) noexcept;

 private:
  std::uint64_t generation_ = 0;
  double drift_m_ = 0;
};

/// Who is near whom, found once and kept while no robot has moved far (neighbour lists; L. Verlet,
/// Physical Review 159, 98, 1967). A block of askers, each at a place of its own, has two lists of
/// numbers each: what lay within its reach and a margin when they were made. Until askers and
/// robots together have moved by the margin, nothing else can have come within the reach. When a
/// list is made is part of no result, as long as who reads it checks the distances again. Any
/// thread, one at a time.
class NearLists {
 public:
  /// The reach beyond what is asked for that pays if something moves by `moves_m` between one use
  /// and the next, askers and robots alike: long enough for several uses and at most `most_m`; 0 if
  /// lists do not pay.
  [[nodiscard]] static double margin_for(double moves_m, double most_m) noexcept {
    constexpr double kUses = 6;
    constexpr double kFewUses = 2;
    constexpr double kLeast_m = 0.05;
    const double margin_m = std::min(std::max(kLeast_m, 2 * kUses * moves_m), most_m);
    return margin_m >= 2 * kFewUses * moves_m ? margin_m : 0;
  }

  /// Whether lists were made that hold for askers at `places`, as many as there were, which look
  /// `more_m` farther than they did then.
  [[nodiscard]] bool hold(const world::Snapshot& world, std::span<const Vec2> places,
                          double more_m = 0) const noexcept;
  /// Forgets all lists and makes room for those of askers at `places`. First() and second() of each
  /// asker in turn are then given by add() and end_list().
  void begin(const world::Snapshot& world, std::span<const Vec2> places, double margin_m);
  void add(std::uint32_t number) { numbers_.push_back(number); }
  void end_list() { ends_.push_back(static_cast<std::uint32_t>(numbers_.size())); }

  [[nodiscard]] std::span<const std::uint32_t> first(std::size_t asker) const noexcept {
    return between(2 * asker);
  }
  [[nodiscard]] std::span<const std::uint32_t> second(std::size_t asker) const noexcept {
    return between(2 * asker + 1);
  }
  /// All lists of all askers, each asker's first() and second(), one behind the other.
  [[nodiscard]] std::span<const std::uint32_t> all() const noexcept { return numbers_; }

 private:
  [[nodiscard]] std::span<const std::uint32_t> between(std::size_t list) const noexcept {
    return {numbers_.data() + ends_[list], ends_[list + 1] - ends_[list]};
  }

  std::vector<Vec2> places_;  ///< Of the askers when the lists were made; empty: there are none.
  std::vector<std::uint32_t> numbers_;
  std::vector<std::uint32_t> ends_;  ///< Two per asker, behind a 0.
  std::uint64_t generation_ = 0;
  double drift_m_ = 0;
  double margin_m_ = 0;
};

}  // namespace rave::sim
