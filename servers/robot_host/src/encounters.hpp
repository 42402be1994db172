// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinds.hpp"
#include "observer.hpp"

namespace rave::robot_host {

/// The nearest that a pair of bodies of two kinds came.
struct Encounter {
  double gap_m = 0;      ///< Between their outlines; negative if they overlapped.
  double centres_m = 0;  ///< Between their origins.
  double time_s = 0;
  std::uint32_t a = 0;  ///< Body ids; `a` is a robot.
  std::uint32_t b = 0;
};

/// Keeps the closest approach of each kind of pair, such as `real-simulated`. Bodies farther apart
/// than its reach never count.
class Encounters final : public Observer {
 public:
  Encounters(const BodyKinds& kinds, const sim::EngineSpec& spec);

  void after_step(sim::Engine& engine) override;

  [[nodiscard]] const std::map<std::string, Encounter>& closest() const noexcept {
    return closest_;
  }
  /// `real-simulated 0.42 m` of the closest of all robot pairs; empty if there was none.
  [[nodiscard]] std::string headline() const;

  static constexpr double kReach_m = 2.0;

 private:
  void look_around(const sim::Engine& engine, RobotId robot);

  const BodyKinds* kinds_;
  std::uint64_t every_ = 1;
  std::vector<double> radius_m_;
  std::vector<std::uint32_t> found_;
  std::map<std::string, Encounter> closest_;
};

}  // namespace rave::robot_host
