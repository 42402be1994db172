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

/// Keeps the closest approach of each kind of pair, such as `real-simulated`. Bodies farther apart
/// than its reach never count. Of robots of several hosts, each pair is its host's whose id is
/// lower.
class Encounters final : public RunObserver {
 public:
  Encounters(const BodyKinds& kinds, const sim::EngineSpec& spec);

  void after_step(const StepView& step) override;

  [[nodiscard]] std::map<std::string, Encounter> closest() const;
  /// `real-simulated 0.42 m` of the closest of all robot pairs; empty if there was none.
  [[nodiscard]] std::string headline() const;

  static constexpr double kReach_m = 2.0;

 private:
  /// The closest of one kind of pair so far.
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
  std::vector<Kind> kinds_of_pairs_;  ///< A handful; all that there can be.
  std::uint64_t foreseen_ = 0;        ///< Revision of the kinds of bodies that they are for.
  double reach_now_m_ = kReach_m;
};

}  // namespace rave::runtime
