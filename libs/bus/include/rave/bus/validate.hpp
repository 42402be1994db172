// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/base/result.hpp"
#include "rave/bus/topics.hpp"

namespace rave::bus {

/// No coordinate is further out, and nothing is faster: what exceeds these is a broken sender.
inline constexpr double kMaxPosition_m = 1e7;
inline constexpr double kMaxSpeed_mps = 1e4;
inline constexpr double kMaxTurn_radps = 1e4;

/// What makes a sample unusable whoever looks at it: numbers that are not finite or out of bounds,
/// arrays of one robot list that differ in length, ids that do not ascend, more than the wire types
/// allow, a body that is not convex. Error kInvalidArgument with field, entry and value. Pure.
/// Readers call these for every sample; whether it fits the run is the receiver's to judge
/// (check_step, HostClaims).
[[nodiscard]] Status validate(const HostReport& sample);
[[nodiscard]] Status validate(const WorldStep& sample);
[[nodiscard]] Status validate(const RunState& sample);
[[nodiscard]] Status validate(const HostState& sample);
[[nodiscard]] Status validate(const World& sample);
[[nodiscard]] Status validate(const RosterEntry& sample);
[[nodiscard]] Status validate(const Obstacle& sample);
[[nodiscard]] Status validate(const Edit& sample);
[[nodiscard]] Status validate(const Command& sample);
[[nodiscard]] Status validate(const Packet& sample);
[[nodiscard]] Status validate(const HostInfo& sample);
[[nodiscard]] Status validate(const LineInfo& sample);
[[nodiscard]] Status validate(const LineWithdrawal& sample);
[[nodiscard]] Status validate(const ProcessState& sample);
[[nodiscard]] Status validate(const ClockPing& sample);
[[nodiscard]] Status validate(const ClockPong& sample);
[[nodiscard]] Status validate(const FindingsPart& sample);
[[nodiscard]] Status validate(const Look& sample);
[[nodiscard]] Status validate(const Readings& sample);
[[nodiscard]] Status validate(const RunEvents& sample);
[[nodiscard]] Status validate(const MapTile& sample);
[[nodiscard]] Status validate(const Wish& sample);
[[nodiscard]] Status validate(const WishAnswer& sample);

/// Whether a sample of `step` is of use to somebody at `now`: at most `behind` steps back and
/// `ahead` steps in front. Error kState.
[[nodiscard]] Status check_step(std::uint64_t step, std::uint64_t now, std::uint64_t behind,
                                std::uint64_t ahead);

}  // namespace rave::bus
