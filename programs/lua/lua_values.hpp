// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/robot/percepts.hpp"
#include "rave/script/value.hpp"

// What a robot receives, as values of a script. Pure; any thread.
namespace rave::lua {

/// A sample. One record: a table of its fields, or nil if it is empty; rays and values: a list of
/// numbers; things that are seen: a list of tables.
[[nodiscard]] script::Value sample_value(ReadingKind kind, std::uint32_t count,
                                         const std::byte* records);
/// `{kind = "goal", x = 1, y = 2, by = "anna"}`, with `yaw`, `speed`, `points` or `text` as far as
/// it has them.
[[nodiscard]] script::Value order_value(const Order& order);
/// `{x = 1, y = 2, yaw = 0.5}`.
[[nodiscard]] script::Value pose_value(const PoseReading& pose);
/// `{from = 3, text = "..."}`.
[[nodiscard]] script::Value message_value(const Message& message);

}  // namespace rave::lua
