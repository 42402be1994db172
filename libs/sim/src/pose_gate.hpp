// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "pose_reading.hpp"
#include "rave/robot/sample_gate.hpp"
#include "rave/sim/engine_spec.hpp"

namespace rave::sim {

/// What a robot can do at most, as far as its poses go.
struct PoseReach {
  double max_speed_mps = 0;
  double max_turn_radps = 0;
};

/// Of a type of robot: what its file says, else the limits of its guard, else what no robot of its
/// sort exceeds.
[[nodiscard]] PoseReach reach_of(const RobotType& type) noexcept;

/// Refuses poses that the robot cannot have reached since the last good one, however it drove: that
/// are farther away than its fastest motion and the noise of both poses explain. A pose that is not
/// finite is refused, too.
///
/// Poses that are refused, agree with each other for half a second, and are never interrupted by a
/// good one, are a new place: a person has carried the robot, or the origin of the source has
/// moved. The last of them begins anew.
class PoseGate final : public SampleGate {
 public:
  PoseGate(ReadingKind kind, PoseReach reach) noexcept : kind_(kind), reach_(reach) {}

  [[nodiscard]] Verdict judge(SimTime stamp, const void* record) override;
  [[nodiscard]] std::string reason() const override;
  void reset() noexcept override;

 private:
  struct Place {
    SimTime stamp;
    PoseReading pose;
  };
  /// Whether the robot can have come from one place to the other.
  [[nodiscard]] bool reaches(const Place& from, const Place& to) const noexcept;

  const ReadingKind kind_;
  const PoseReach reach_;
  bool known_ = false;
  Place good_;  ///< The last one that passed.
  Place from_;  ///< The one before it, if it began anew.
  Place odd_;   ///< The last one that was refused.
  SimTime odd_since_;
  std::int32_t odd_in_a_row_ = 0;
};

}  // namespace rave::sim
