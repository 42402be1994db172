// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

// A RandomStream is chosen by seed, robot, device and sample. Sensors use their index as the
// device. All other sources of random numbers of a robot add one of these bits, so that no two
// sources use the same numbers.
namespace rave::sim {

/// The `processing:` of the robot file, of the sensor with this index.
inline constexpr std::uint32_t kProcessingDevice = 1U << 31;
/// The actuator with this index.
inline constexpr std::uint32_t kActuatorDevice = 1U << 30;
/// The virtual half of the hybrid sensor with this index.
inline constexpr std::uint32_t kVirtualHalfDevice = 1U << 29;
/// The real half of the hybrid sensor with this index.
inline constexpr std::uint32_t kRealHalfDevice = 1U << 28;
/// A sensor that belongs to no robot of the run (LoneSensor).
inline constexpr std::uint32_t kLoneDevice = 1U << 27;

}  // namespace rave::sim
