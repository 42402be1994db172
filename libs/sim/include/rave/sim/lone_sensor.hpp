// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "rave/base/result.hpp"
#include "rave/robot/reading.hpp"
#include "rave/sim/engine_spec.hpp"
#include "rave/world/snapshot.hpp"

namespace rave::sim {

/// A virtual sensor outside of the run: it senses the world of the run from the pose of a robot,
/// and the run does not depend on it. Its readings are those of the driver, without the noise and
/// filters of a robot file. One thread.
class LoneSensor {
 public:
  /// Upper limits of readings per sample and of rays.
  static constexpr std::uint32_t kMostRecords = 4096;
  static constexpr std::uint32_t kMostRays = 16'384;

  /// `spec`: a virtual sensor whose driver stays loaded as long as this object. `step_s`: step of
  /// the run. Errors: kInvalidArgument (not virtual, too many readings or rays), kPlugin (error of
  /// the driver).
  [[nodiscard]] static Result<std::unique_ptr<LoneSensor>> make(SensorSpec spec, double step_s);
  LoneSensor(const LoneSensor&) = delete;
  LoneSensor& operator=(const LoneSensor&) = delete;
  ~LoneSensor();

  [[nodiscard]] const SensorSpec& spec() const noexcept;
  /// Valid as long as this object.
  [[nodiscard]] const SensorInfo& info() const noexcept;
  /// Senses the world from the pose of `robot`; no effect if the robot is absent. `seed`: seed of
  /// the run. Error kPlugin: the driver failed and will not be called again.
  Status sample(const world::Snapshot& world, RobotId robot, std::uint64_t seed);
  /// Header of the last sample; sequence 0: none.
  [[nodiscard]] const SampleHeader& header() const noexcept;
  [[nodiscard]] const void* records() const noexcept;

 private:
  struct Parts;
  explicit LoneSensor(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace rave::sim
