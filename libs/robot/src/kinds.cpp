// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <iterator>

#include "rave/base/word_table.hpp"
#include "rave/robot/command.hpp"
#include "rave/robot/order.hpp"
#include "rave/robot/reading.hpp"

namespace rave {
namespace {

constexpr std::size_t index_of(ReadingKind kind) noexcept { return static_cast<std::size_t>(kind); }

/// In the order of the kinds.
constexpr struct {
  std::string_view name;
  std::uint32_t record_bytes;
} kReadings[] = {{"nothing", 0},
                 {"ranges", sizeof(float)},
                 {"sightings", sizeof(Sighting)},
                 {"pose", sizeof(PoseReading)},
                 {"odometry", sizeof(OdometryReading)},
                 {"neighbours", sizeof(NeighbourReading)},
                 {"contact", sizeof(ContactReading)},
                 {"velocity", sizeof(VelocityReading)},
                 {"values", sizeof(double)}};
static_assert(std::size(kReadings) == index_of(ReadingKind::kValues) + 1);

constexpr WordTable<OrderKind, 7> kOrders = {{
    {"nothing", OrderKind::kNone},
    {"drive", OrderKind::kDrive},
    {"goal", OrderKind::kGoal},
    {"path", OrderKind::kPath},
    {"cancel", OrderKind::kCancel},
    {"text", OrderKind::kText},
    {"place", OrderKind::kPlace},
}};

constexpr WordTable<CommandKind, 5> kCommands = {{
    {"nothing", CommandKind::kNone},
    {"velocity", CommandKind::kVelocity},
    {"goal", CommandKind::kGoal},
    {"joint", CommandKind::kJoint},
    {"values", CommandKind::kValues},
}};

}  // namespace

std::string_view to_string(ReadingKind kind) noexcept {
  return kind <= ReadingKind::kValues ? kReadings[index_of(kind)].name : "unknown";
}

std::uint32_t record_size(ReadingKind kind) noexcept {
  return kind <= ReadingKind::kValues ? kReadings[index_of(kind)].record_bytes : 0;
}

std::string_view to_string(OrderKind kind) noexcept { return kOrders.of(kind, "unknown"); }

std::string_view to_string(CommandKind kind) noexcept { return kCommands.of(kind, "unknown"); }

}  // namespace rave
