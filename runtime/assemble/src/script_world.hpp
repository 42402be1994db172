// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/math/pose.hpp"
#include "rave/script/script.hpp"
#include "rave/sim/conductor.hpp"

namespace rave::runtime {

/// The functions with which conditions and scripts look at the world: `time()`, `x(NAME)`,
/// `y(NAME)`, `yaw_deg(NAME)`, `speed(NAME)`, `present(NAME)`, `touches(NAME)`, `distance(A, B)`,
/// `robots()`, `random()`. A name is that of a robot or of an obstacle; a place is a name or `{x,
/// y}`. Numbers are in metres, degrees, seconds and the world frame. Of a robot that is not in the
/// world, and of an obstacle that is gone, they give nothing (nil), and no condition on it holds.
class ScriptWorld {
 public:
  ScriptWorld(std::vector<std::string> robots, std::uint64_t seed);

  /// To be given to the script; this object must outlive it.
  [[nodiscard]] std::vector<script::Provided> functions();
  /// What the functions see from now on; null: nothing, between steps.
  void show(const sim::WorldLook* world) noexcept {
    world_ = world;
    draws_ = 0;
  }
  [[nodiscard]] const sim::WorldLook* world() const noexcept { return world_; }
  /// As the file is read, the functions can be called, but there is no world yet.
  [[nodiscard]] Status check_world() const;

 private:
  using Arguments = std::span<const script::Value>;
  [[nodiscard]] Result<std::optional<Pose2>> place(const script::Value& value) const;
  [[nodiscard]] Result<RobotId> robot(Arguments arguments) const;
  [[nodiscard]] script::Provided of_pose(std::string name, double (*part)(const Pose2&));
  [[nodiscard]] script::Provided of_robot(std::string name,
                                          script::Value (*part)(const sim::WorldLook& world,
                                                                RobotId robot));
  [[nodiscard]] Result<script::Value> distance(Arguments arguments) const;
  [[nodiscard]] script::Value random();
  [[nodiscard]] std::string nearest(std::string_view name) const;

  std::vector<std::string> robots_;
  std::map<std::string, RobotId, std::less<>> ids_;
  std::uint64_t seed_;
  const sim::WorldLook* world_ = nullptr;
  std::uint32_t draws_ = 0;  ///< In this step.
};

}  // namespace rave::runtime
