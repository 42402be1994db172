// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "rave/base/ids.hpp"
#include "rave/config/robot_file.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/robot/actuator.hpp"

namespace rave::runtime {

/// A simulated actuator that runs without an engine.
class GapTwin {
 public:
  /// Loads the simulated actuator of a robot file in `folder`. `robot` selects its random numbers.
  /// Errors: kInvalidArgument if the robot has none; those of loading the driver.
  [[nodiscard]] static Result<GapTwin> make(config::RobotFile robot,
                                            const std::filesystem::path& file, double step_s,
                                            std::uint64_t seed, RobotId id,
                                            plugin::Catalogue& catalogue);
  GapTwin(GapTwin&&) noexcept;
  GapTwin& operator=(GapTwin&&) noexcept;
  ~GapTwin();

  [[nodiscard]] const std::string& driver() const noexcept;
  [[nodiscard]] CommandKind accepts() const noexcept;
  /// The body velocity in step `step` of the recording. Errors: kPlugin.
  [[nodiscard]] Result<Twist2> propose(const Command& command, std::uint64_t step);

 private:
  struct Impl;
  explicit GapTwin(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::runtime
