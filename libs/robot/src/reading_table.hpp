// SPDX-License-Identifier: Apache-2.0
// The fields of all kinds of readings.
#pragma once

#include <concepts>
#include <cstddef>
#include <iterator>

#include "rave/robot/reading_type.hpp"

namespace rave::detail {

template <class Number>
constexpr NumberFormat format_of() noexcept {
  if constexpr (std::same_as<Number, std::int32_t>) return NumberFormat::kInt32;
  if constexpr (std::same_as<Number, std::uint32_t>) return NumberFormat::kUint32;
  if constexpr (std::same_as<Number, std::int64_t>) return NumberFormat::kInt64;
  if constexpr (std::same_as<Number, float>) return NumberFormat::kFloat32;
  static_assert(std::integral<Number> || std::floating_point<Number>);
  return NumberFormat::kFloat64;
}

// Name, place and format of a member; then label and unit, and what noise and filters do.
#define RAVE_FIELD(Record, member, label, unit, ...)                                       \
  ReadingField {                                                                           \
    #member, label, unit, format_of<decltype(Record::member)>(), offsetof(Record, member), \
        __VA_ARGS__                                                                        \
  }

inline constexpr bool kFiltered = true;
using enum NoiseTerm;
using enum ReadingShape;

inline constexpr ReadingField kRangesFields[] = {
    {"range_m", "range", "m", NumberFormat::kFloat32, 0, kDistance, kFiltered}};

inline constexpr ReadingField kSightingFields[] = {
    RAVE_FIELD(Sighting, stamp_ns, "stamp", "ns"), RAVE_FIELD(Sighting, code, "code", ""),
    RAVE_FIELD(Sighting, range_m, "range", "m", kDistance),
    RAVE_FIELD(Sighting, bearing_rad, "bearing", "rad", kAngle),
    RAVE_FIELD(Sighting, reserved, "reserved", "")};

inline constexpr ReadingField kPoseFields[] = {
    RAVE_FIELD(PoseReading, x_m, "x", "m", kCoordinate, kFiltered, "variance_xy_m2"),
    RAVE_FIELD(PoseReading, y_m, "y", "m", kCoordinate, kFiltered, "variance_xy_m2"),
    RAVE_FIELD(PoseReading, yaw_rad, "yaw", "rad", kAngle, kFiltered, "variance_yaw_rad2"),
    RAVE_FIELD(PoseReading, variance_xy_m2, "variance xy", "m²"),
    RAVE_FIELD(PoseReading, variance_yaw_rad2, "variance yaw", "rad²")};

inline constexpr ReadingField kOdometryFields[] = {
    RAVE_FIELD(OdometryReading, x_m, "x", "m", kCoordinate, kFiltered, "variance_xy_m2"),
    RAVE_FIELD(OdometryReading, y_m, "y", "m", kCoordinate, kFiltered, "variance_xy_m2"),
    RAVE_FIELD(OdometryReading, yaw_rad, "yaw", "rad", kAngle, kFiltered, "variance_yaw_rad2"),
    RAVE_FIELD(OdometryReading, v_mps, "v", "m/s", kVelocity, kFiltered),
    RAVE_FIELD(OdometryReading, w_radps, "w", "rad/s", kNone, kFiltered),
    RAVE_FIELD(OdometryReading, variance_xy_m2, "variance xy", "m²"),
    RAVE_FIELD(OdometryReading, variance_yaw_rad2, "variance yaw", "rad²")};

inline constexpr ReadingField kNeighbourFields[] = {
    RAVE_FIELD(NeighbourReading, robot, "robot", ""),
    RAVE_FIELD(NeighbourReading, range_m, "range", "m", kDistance),
    RAVE_FIELD(NeighbourReading, bearing_rad, "bearing", "rad", kAngle),
    RAVE_FIELD(NeighbourReading, vx_mps, "vx", "m/s", kVelocity),
    RAVE_FIELD(NeighbourReading, vy_mps, "vy", "m/s", kVelocity),
    RAVE_FIELD(NeighbourReading, reserved, "reserved", "")};

inline constexpr ReadingField kContactFields[] = {
    RAVE_FIELD(ContactReading, touching, "touching", ""),
    RAVE_FIELD(ContactReading, bearing_rad, "bearing", "rad")};

inline constexpr ReadingField kVelocityFields[] = {
    RAVE_FIELD(VelocityReading, v_mps, "v", "m/s", kVelocity, kFiltered),
    RAVE_FIELD(VelocityReading, w_radps, "w", "rad/s", kNone, kFiltered)};

inline constexpr ReadingField kValuesFields[] = {
    {"value", "value", "", NumberFormat::kFloat64, 0, kNone, kFiltered}};

#undef RAVE_FIELD

/// All of a record is shown, except a stamp in front and reserved bytes behind.
constexpr std::span<const ReadingField> columns_of(std::span<const ReadingField> fields) noexcept {
  if (fields.front().name == "stamp_ns") fields = fields.subspan(1);
  if (fields.back().name == "reserved") fields = fields.first(fields.size() - 1);
  return fields;
}

template <class Record>
constexpr ReadingType row(std::string_view name, std::string_view record, ReadingShape shape,
                          std::span<const ReadingField> fields) noexcept {
  return {name, record, shape, sizeof(Record), fields, columns_of(fields)};
}

/// In the order of the kinds.
inline constexpr ReadingType kReadingTypes[] = {
    {"nothing", {}, kState, 0, {}, {}},
    row<float>("ranges", "float", kSeries, kRangesFields),
    row<Sighting>("sightings", "Sighting", kList, kSightingFields),
    row<PoseReading>("pose", "PoseReading", kState, kPoseFields),
    row<OdometryReading>("odometry", "OdometryReading", kState, kOdometryFields),
    row<NeighbourReading>("neighbours", "NeighbourReading", kList, kNeighbourFields),
    row<ContactReading>("contact", "ContactReading", kState, kContactFields),
    row<VelocityReading>("velocity", "VelocityReading", kState, kVelocityFields),
    row<double>("values", "double", kSeries, kValuesFields)};
inline constexpr std::size_t kReadingKinds = std::size(kReadingTypes);
static_assert(kReadingKinds == static_cast<std::size_t>(ReadingKind::kValues) + 1);

}  // namespace rave::detail
