// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rave/report/palette.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

/// Names, kinds and colours of the bodies of a run.
class BodyKinds {
 public:
  /// `robot_words`: the `kind` of each robot in the scenario, such as `hunter`; empty for none.
  BodyKinds(const sim::EngineSpec& spec, const std::vector<std::string>& robot_words);

  /// Adds new obstacles of the world; call it before querying them.
  void learn(const world::WorldModel& world);
  /// Updates the kinds of robots that were handed over in the last step.
  void follow(const sim::Engine& engine);

  /// `real`, `simulated`, `landmark`, `mapped_wall` or `virtual_obstacle`.
  [[nodiscard]] std::string_view word(std::uint32_t body) const { return words_[body]; }
  [[nodiscard]] report::Kind kind(std::uint32_t body) const { return kinds_[body]; }
  [[nodiscard]] std::string colour(std::uint32_t body) const { return colours_[body]; }
  [[nodiscard]] std::string_view name(std::uint32_t body) const { return names_[body]; }
  [[nodiscard]] std::uint32_t body_of(RobotId robot) const noexcept {
    return first_robot_ + robot.value();
  }
  [[nodiscard]] bool is_robot(std::uint32_t body) const noexcept {
    return body >= first_robot_ && body < first_added_;
  }
  [[nodiscard]] std::uint32_t count() const noexcept {
    return static_cast<std::uint32_t>(words_.size());
  }
  /// Changes whenever a body was added or changed its kind.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }

 private:
  void add(const world::Body& obstacle);

  void set_reality(RobotId robot, bool simulated);

  std::uint32_t first_robot_ = 0;
  std::uint32_t first_added_ = 0;  ///< The id after the robots.
  std::uint64_t revision_ = 0;
  std::vector<std::string_view> words_;
  std::vector<report::Kind> kinds_;
  std::vector<std::string> colours_;
  std::vector<std::string> names_;
  std::vector<std::uint8_t> hunters_;  ///< By robot.
};

}  // namespace rave::runtime
