// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/observe/kinds.hpp"
#include "rave/observe/run_observer.hpp"
#include "rave/results/facts.hpp"

namespace rave::runtime {

/// Finds the closest approach of each kind of pair of bodies, such as `real-simulated`. Pairs
/// farther apart than its reach are ignored. With several hosts, a pair belongs to the host of the
/// robot with the lower id.
class Encounters final : public RunObserver {
 public:
  Encounters(const BodyKinds& kinds, const sim::EngineSpec& spec);

  void after_step(const StepView& step) override;

  [[nodiscard]] std::map<std::string, Encounter> closest() const;
  /// The closest of all pairs of robots, such as `real-simulated 0.42 m`; empty if there was none.
  [[nodiscard]] std::string headline() const;

  static constexpr double kReach_m = 2.0;

 private:
  /// The closest pair of one kind so far.
  struct Kind {
    std::string_view a;
    std::string_view b;
    std::optional<Encounter> closest{};
  };
  void look_around(const sim::Engine& engine, RobotId robot);
  Kind& kind_of(std::uint32_t robot, std::uint32_t other);
  void foresee_kinds();
  [[nodiscard]] double reach_m() const;

  const BodyKinds* kinds_;
  std::uint64_t every_ = 1;
  std::vector<double> radius_m_;
  std::vector<std::uint32_t> found_;
  std::vector<Kind> kinds_of_pairs_;  ///< All possible kinds of pairs; a few.
  std::uint64_t foreseen_ = 0;        ///< BodyKinds::revision() for which they were made.
  double reach_now_m_ = kReach_m;
};

}  // namespace rave::runtime
