// SPDX-License-Identifier: Apache-2.0
#include "rave/base/word_table.hpp"
#include "rave/robot/command.hpp"
#include "rave/robot/order.hpp"

namespace rave {
namespace {

constexpr WordTable<OrderKind, 7> kOrders = {{
    {"nothing", OrderKind::kNone},
    {"drive", OrderKind::kDrive},
    {"goal", OrderKind::kGoal},
    {"path", OrderKind::kPath},
    {"cancel", OrderKind::kCancel},
    {"text", OrderKind::kText},
    {"place", OrderKind::kPlace},
}};

constexpr WordTable<CommandKind, 6> kCommands = {{
    {"nothing", CommandKind::kNone},
    {"velocity", CommandKind::kVelocity},
    {"goal", CommandKind::kGoal},
    {"joint", CommandKind::kJoint},
    {"values", CommandKind::kValues},
    {"pedals", CommandKind::kPedals},
}};

}  // namespace

std::string_view to_string(OrderKind kind) noexcept { return kOrders.of(kind, "unknown"); }

std::string_view to_string(CommandKind kind) noexcept { return kCommands.of(kind, "unknown"); }

}  // namespace rave
