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

/// One simulated actuator on its own, without an engine around it.
class GapTwin {
 public:
  /// The simulated actuator of a robot file; `folder` is where that lies. `robot`: whose chance it
  /// draws. Errors: kInvalidArgument if the robot has none, those of loading the driver.
  [[nodiscard]] static Result<GapTwin> make(config::RobotFile robot,
                                            const std::filesystem::path& file, double step_s,
                                            std::uint64_t seed, RobotId id,
                                            plugin::Catalogue& catalogue);
  GapTwin(GapTwin&&) noexcept;
  GapTwin& operator=(GapTwin&&) noexcept;
  ~GapTwin();

  [[nodiscard]] const std::string& driver() const noexcept;
  [[nodiscard]] CommandKind accepts() const noexcept;
  /// The body velocity in the step of that number of the record. Errors: kPlugin.
  [[nodiscard]] Result<Twist2> propose(const Command& command, std::uint64_t step);

 private:
  struct Impl;
  explicit GapTwin(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::runtime
