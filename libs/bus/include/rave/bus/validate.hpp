// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/base/result.hpp"
#include "rave/bus/topics.hpp"

namespace rave::bus {

/// Upper limits of coordinates and speeds. Larger values can only come from a faulty sender.
inline constexpr double kMaxPosition_m = 1e7;
inline constexpr double kMaxSpeed_mps = 1e4;
inline constexpr double kMaxTurn_radps = 1e4;

/// Checks what any receiver can check: finite numbers within bounds, arrays of equal length for one
/// list of robots, ascending ids, sizes within the wire types, convex bodies. Error
/// kInvalidArgument with field, entry and value. Pure. Readers call it for every sample; whether
/// the sample fits the run is checked by the receiver (HostClaims).
[[nodiscard]] Status validate(const HostReport& sample);
[[nodiscard]] Status validate(const WorldStep& sample);
[[nodiscard]] Status validate(const RunState& sample);
[[nodiscard]] Status validate(const HostState& sample);
[[nodiscard]] Status validate(const World& sample);
[[nodiscard]] Status validate(const RosterEntry& sample);
[[nodiscard]] Status validate(const Obstacle& sample);
[[nodiscard]] Status validate(const Command& sample);
[[nodiscard]] Status validate(const CommandAnswer& sample);
[[nodiscard]] Status validate(const Packet& sample);
[[nodiscard]] Status validate(const HostInfo& sample);
[[nodiscard]] Status validate(const LineInfo& sample);
[[nodiscard]] Status validate(const LineWithdrawal& sample);
[[nodiscard]] Status validate(const ProcessState& sample);
[[nodiscard]] Status validate(const ClockPing& sample);
[[nodiscard]] Status validate(const ClockPong& sample);
[[nodiscard]] Status validate(const HostResultsPart& sample);
[[nodiscard]] Status validate(const Look& sample);
[[nodiscard]] Status validate(const Readings& sample);
[[nodiscard]] Status validate(const RunEvents& sample);
[[nodiscard]] Status validate(const MapTile& sample);
[[nodiscard]] Status validate(const Request& sample);
[[nodiscard]] Status validate(const RequestAnswer& sample);

}  // namespace rave::bus
