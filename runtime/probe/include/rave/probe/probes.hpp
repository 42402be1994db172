// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "rave/plugin/catalogue.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/lone_sensor.hpp"

namespace rave::probe {

/// Numbers of probes have this bit, so no sensor of a robot has one of them.
inline constexpr std::uint32_t kProbeBit = 0x8000'0000U;
/// The rows of its readings begin with the number of a robot.
inline constexpr std::uint32_t kNamesRobotsBit = 0x4000'0000U;

[[nodiscard]] constexpr bool is_probe(std::uint32_t sensor) noexcept {
  return (sensor & kProbeBit) != 0;
}

/// A virtual sensor that somebody wants to try on a robot.
struct Asked {
  std::uint32_t robot = 0;
  std::uint32_t number = 0;  ///< With kProbeBit; whoever asks chooses it.
  std::string block;         ///< As read_block() takes it.
  friend auto operator<=>(const Asked&, const Asked&) = default;
};

/// The probes on the robots of one host: virtual sensors that look at the world of the run beside
/// it while somebody looks at them. No part of the run: nothing in it depends on them. Without one
/// nothing is computed. The thread of the run; must be gone before the catalogue.
class Probes {
 public:
  /// At one host, whoever asks.
  static constexpr std::size_t kMost = 16;

  /// All that are asked for now: begins those that are new, and ends the others. `catalogue`: of
  /// the run. Of one number the first that came counts.
  void ask(const sim::Engine& engine, plugin::Catalogue& catalogue, std::span<const Asked> asked);
  /// Senses the world of the last step, once for each step that is asked about.
  void sample(const sim::Engine& engine);
  [[nodiscard]] bool empty() const noexcept { return probes_.empty(); }

  /// By robot and number; null where the sensor cannot be made here.
  [[nodiscard]] const std::map<std::pair<std::uint32_t, std::uint32_t>,
                               std::unique_ptr<sim::LoneSensor>>&
  all() const noexcept {
    return probes_;
  }

 private:
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::unique_ptr<sim::LoneSensor>> probes_;
  std::vector<Asked> asked_;  ///< As it was said last.
};

}  // namespace rave::probe
