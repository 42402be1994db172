// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/robot/command.hpp"
#include "rave/robot/message.hpp"
#include "rave/robot/reading.hpp"

// Handles: names that a program looks up once, in start().
namespace rave {

/// A device with its description; looked up by name once, used every step.
template <class Info>
class DeviceHandle {
 public:
  DeviceHandle() = default;
  explicit DeviceHandle(std::uint32_t index, const Info* info) : index_(index), info_(info) {}
  [[nodiscard]] bool valid() const noexcept { return info_ != nullptr; }
  [[nodiscard]] std::uint32_t index() const noexcept { return index_; }
  /// Name, mounting, rays and limits, as far as the device has them. The handle must be valid.
  [[nodiscard]] const Info& info() const noexcept { return *info_; }

 private:
  std::uint32_t index_ = 0;
  const Info* info_ = nullptr;
};

/// A sensor of one kind of records.
template <class Record>
class SensorHandle : public DeviceHandle<SensorInfo> {
 public:
  using DeviceHandle::DeviceHandle;
};

/// A range sensor: one float in metres per ray; +infinity means no return.
using RangesHandle = SensorHandle<float>;

/// A controller; looked up by name once.
class ControllerHandle {
 public:
  ControllerHandle() = default;
  explicit ControllerHandle(std::uint32_t index) : index_(index), valid_(true) {}
  [[nodiscard]] bool valid() const noexcept { return valid_; }
  [[nodiscard]] std::uint32_t index() const noexcept { return index_; }

 private:
  std::uint32_t index_ = 0;
  bool valid_ = false;
};

/// A communicator.
using CommunicatorHandle = DeviceHandle<CommunicatorInfo>;

namespace detail {
/// The kind of the readings whose records are of type `Record`.
template <class Record>
inline constexpr ReadingKind kKindOf = ReadingKind::kNone;
template <>
inline constexpr ReadingKind kKindOf<float> = ReadingKind::kRanges;
template <>
inline constexpr ReadingKind kKindOf<Sighting> = ReadingKind::kSightings;
template <>
inline constexpr ReadingKind kKindOf<PoseReading> = ReadingKind::kPose;
template <>
inline constexpr ReadingKind kKindOf<OdometryReading> = ReadingKind::kOdometry;
template <>
inline constexpr ReadingKind kKindOf<NeighbourReading> = ReadingKind::kNeighbours;
template <>
inline constexpr ReadingKind kKindOf<ContactReading> = ReadingKind::kContact;
template <>
inline constexpr ReadingKind kKindOf<VelocityReading> = ReadingKind::kVelocity;
template <>
inline constexpr ReadingKind kKindOf<double> = ReadingKind::kValues;

template <class Record>
concept ReadingRecord = kKindOf<Record> != ReadingKind::kNone;
}  // namespace detail

}  // namespace rave
