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

/// A bit of the numbers of probes that no sensor index has.
inline constexpr std::uint32_t kProbeBit = 0x8000'0000U;
/// Set if the rows of its readings begin with the id of a robot.
inline constexpr std::uint32_t kNamesRobotsBit = 0x4000'0000U;

[[nodiscard]] constexpr bool is_probe(std::uint32_t sensor) noexcept {
  return (sensor & kProbeBit) != 0;
}

/// A request to try a virtual sensor on a robot.
struct Asked {
  std::uint32_t robot = 0;
  std::uint32_t number = 0;  ///< Includes kProbeBit; chosen by the requester.
  std::string block;         ///< See read_block().
  friend auto operator<=>(const Asked&, const Asked&) = default;
};

/// The probes on the robots of one host: virtual sensors that sense the world of the run while a
/// user views them. The run does not depend on them. Without probes there is no cost. Thread: that
/// of the run; destroy it before the catalogue.
class Probes {
 public:
  /// Limit per host, for all users together.
  static constexpr std::size_t kMost = 16;

  /// Sets the requested probes: creates new ones and removes others. `catalogue`: of the run. If
  /// two have the same number, the first counts.
  void ask(const sim::Engine& engine, plugin::Catalogue& catalogue, std::span<const Asked> asked);
  /// Senses the world of the last step with all probes. Call it at most once per step.
  void sample(const sim::Engine& engine);
  [[nodiscard]] bool empty() const noexcept { return probes_.empty(); }

  /// By robot and number; null if the sensor cannot be created here.
  [[nodiscard]] const std::map<std::pair<std::uint32_t, std::uint32_t>,
                               std::unique_ptr<sim::LoneSensor>>&
  all() const noexcept {
    return probes_;
  }

 private:
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::unique_ptr<sim::LoneSensor>> probes_;
  std::vector<Asked> asked_;  ///< The last request.
};

}  // namespace rave::probe
