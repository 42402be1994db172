// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rave/report/palette.hpp"
#include "rave/sim/engine.hpp"

namespace rave::runtime {

/// What the bodies of a run are called and how they look. Those of the start are fixed then.
class BodyKinds {
 public:
  /// `robot_words`: the free word of each robot, such as `hunter`; empty for none.
  BodyKinds(const sim::EngineSpec& spec, const std::vector<std::string>& robot_words);

  /// Obstacles that came since; call it before asking for them.
  void learn(const world::WorldModel& world);
  /// Robots that were handed over in the last step are another kind now.
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
  /// Another number whenever a body came or became another kind.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }

 private:
  void add(const world::Body& obstacle);

  void set_reality(RobotId robot, bool simulated);

  std::uint32_t first_robot_ = 0;
  std::uint32_t first_added_ = 0;  ///< Behind the robots.
  std::uint64_t revision_ = 0;
  std::vector<std::string_view> words_;
  std::vector<report::Kind> kinds_;
  std::vector<std::string> colours_;
  std::vector<std::string> names_;
  std::vector<std::uint8_t> hunters_;  ///< By robot.
};

}  // namespace rave::runtime
