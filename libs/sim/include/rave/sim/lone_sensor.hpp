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

/// A virtual sensor that belongs to no robot of a run: it looks at the world of the run from the
/// place of a robot, and nothing in the run depends on it. Its readings are those of the driver,
/// without noise and filters of a robot file. One thread.
class LoneSensor {
 public:
  /// So many readings in a sample, and so many rays, at most.
  static constexpr std::uint32_t kMostRecords = 4096;
  static constexpr std::uint32_t kMostRays = 16'384;

  /// `spec`: of a virtual sensor, whose driver stays loaded as long as this. `step_s`: of the run.
  /// Errors: kInvalidArgument (not virtual, too many readings or rays), kPlugin (what the driver
  /// says).
  [[nodiscard]] static Result<std::unique_ptr<LoneSensor>> make(SensorSpec spec, double step_s);
  LoneSensor(const LoneSensor&) = delete;
  LoneSensor& operator=(const LoneSensor&) = delete;
  ~LoneSensor();

  [[nodiscard]] const SensorSpec& spec() const noexcept;
  /// Valid as long as this.
  [[nodiscard]] const SensorInfo& info() const noexcept;
  /// Senses the world from where `robot` is in it; if the robot is not there, nothing. `seed`: of
  /// the run. Error kPlugin: the driver failed, and will not be asked again.
  Status sample(const world::Snapshot& world, RobotId robot, std::uint64_t seed);
  /// Of the last sample; sequence 0: there is none.
  [[nodiscard]] const SampleHeader& header() const noexcept;
  [[nodiscard]] const void* records() const noexcept;

 private:
  struct Parts;
  explicit LoneSensor(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace rave::sim
