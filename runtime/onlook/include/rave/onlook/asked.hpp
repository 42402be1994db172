// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <vector>

#include "rave/probe/probes.hpp"

namespace rave::onlook {

/// A look holds so long after it has come.
inline constexpr std::chrono::seconds kLookHolds{2};

/// A sensor by its robot and its index among those of the robot.
struct LookedAt {
  std::uint32_t robot = 0;
  std::uint32_t sensor = 0;
  friend auto operator<=>(const LookedAt&, const LookedAt&) = default;
};

/// What somebody who looks on asks for.
struct Asked {
  bool robots = false;                ///< What robots report of themselves, and contacts.
  bool parts = false;                 ///< Also the halves of hybrid sensors.
  std::vector<LookedAt> sensors;      ///< Ascending, without repetitions.
  std::vector<std::uint32_t> maps{};  ///< Robots whose local maps; the same.
  std::vector<probe::Asked> probes{};
  friend bool operator==(const Asked&, const Asked&) = default;
};

}  // namespace rave::onlook
