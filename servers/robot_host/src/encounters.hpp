// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "facts.hpp"
#include "kinds.hpp"
#include "observer.hpp"

namespace rave::robot_host {

/// Keeps the closest approach of each kind of pair, such as `real-simulated`. Bodies farther apart
/// than its reach never count. Of robots of several hosts, each pair is its host's whose id is
/// lower.
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
