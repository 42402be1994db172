// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <compare>
#include <cstdint>
#include <vector>

#include "rave/probe/probes.hpp"

namespace rave::onlook {

/// How long a request of a monitor (`Look`) stays valid.
inline constexpr std::chrono::seconds kLookHolds{2};

/// A sensor: the slot of its robot, which is the index in the run or among the robots that a page
/// sees, and the index among the sensors of that robot.
struct LookedAt {
  std::uint32_t slot = 0;
  std::uint32_t sensor = 0;
  friend auto operator<=>(const LookedAt&, const LookedAt&) = default;
};

/// A reading as rows of numbers, row by row.
struct ReadingAt {
  std::uint32_t slot = 0;
  std::uint32_t sensor = 0;
  std::uint8_t part = 0;  ///< 0: for the program, 1: real half, 2: virtual half.
  double stamp_s = 0;
  std::uint32_t rows = 0;
  std::uint32_t fields = 0;
  std::vector<float> values;
};

/// The data that a monitor requests.
struct Asked {
  bool robots = false;            ///< Robot states and contacts.
  bool parts = false;             ///< Also the halves of hybrid sensors.
  std::vector<LookedAt> sensors;  ///< Ascending, without duplicates.
  /// Robots whose local maps are requested; ascending, without duplicates.
  std::vector<std::uint32_t> maps{};
  std::vector<probe::Asked> probes{};
  friend bool operator==(const Asked&, const Asked&) = default;
};

}  // namespace rave::onlook
