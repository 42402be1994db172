// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/command.hpp"
#include "rave/robot/order.hpp"
#include "rave/robot/reading.hpp"

namespace rave {

std::string_view to_string(ReadingKind kind) noexcept {
  switch (kind) {
    case ReadingKind::kNone:
      return "nothing";
    case ReadingKind::kRanges:
      return "ranges";
    case ReadingKind::kSightings:
      return "sightings";
    case ReadingKind::kPose:
      return "pose";
    case ReadingKind::kOdometry:
      return "odometry";
    case ReadingKind::kNeighbours:
      return "neighbours";
    case ReadingKind::kContact:
      return "contact";
    case ReadingKind::kVelocity:
      return "velocity";
    case ReadingKind::kValues:
      return "values";
  }
  return "unknown";
}

std::uint32_t record_size(ReadingKind kind) noexcept {
  switch (kind) {
    case ReadingKind::kNone:
      return 0;
    case ReadingKind::kRanges:
      return sizeof(float);
    case ReadingKind::kSightings:
      return sizeof(Sighting);
    case ReadingKind::kPose:
      return sizeof(PoseReading);
    case ReadingKind::kOdometry:
      return sizeof(OdometryReading);
    case ReadingKind::kNeighbours:
      return sizeof(NeighbourReading);
    case ReadingKind::kContact:
      return sizeof(ContactReading);
    case ReadingKind::kVelocity:
      return sizeof(VelocityReading);
    case ReadingKind::kValues:
      return sizeof(double);
  }
  return 0;
}

std::string_view to_string(OrderKind kind) noexcept {
  switch (kind) {
    case OrderKind::kNone:
      return "nothing";
    case OrderKind::kDrive:
      return "drive";
    case OrderKind::kGoal:
      return "goal";
    case OrderKind::kPath:
      return "path";
    case OrderKind::kCancel:
      return "cancel";
    case OrderKind::kText:
      return "text";
    case OrderKind::kPlace:
      return "place";
  }
  return "unknown";
}

std::string_view to_string(CommandKind kind) noexcept {
  switch (kind) {
    case CommandKind::kNone:
      return "nothing";
    case CommandKind::kVelocity:
      return "velocity";
    case CommandKind::kGoal:
      return "goal";
    case CommandKind::kJoint:
      return "joint";
    case CommandKind::kValues:
      return "values";
  }
  return "unknown";
}

}  // namespace rave
