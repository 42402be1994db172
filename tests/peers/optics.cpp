// SPDX-License-Identifier: Apache-2.0
#include "optics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scip_device.hpp"

namespace peer {

std::vector<int> scan_room(const Room& room, double x, double y, double yaw, double noise_mm,
                           std::mt19937_64& random) {
  std::normal_distribution<double> noise(0, noise_mm);
  std::vector<int> ranges_mm;
  for (int step = ScipDevice::kFirstStep; step <= ScipDevice::kLastStep; ++step) {
    const double bearing =
        2 * std::numbers::pi * (step - ScipDevice::kFrontStep) / ScipDevice::kStepsPerTurn;
    const double mm = room.distance(x, y, yaw + bearing) * 1000 + noise(random);
    ranges_mm.push_back(mm <= ScipDevice::kMost_mm
                            ? std::max(static_cast<int>(std::lround(mm)), ScipDevice::kLeast_mm)
                            : ScipDevice::kNothingInReach);
  }
  return ranges_mm;
}

}  // namespace peer
