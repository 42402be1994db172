// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "rave/robot/command.hpp"
#include "rave/robot/message.hpp"
#include "rave/robot/reading.hpp"

// Handles: names that a program looks up once, in start().
namespace rave {

/// A sensor of one kind of records; looked up by name once, used every step.
template <class Record>
class SensorHandle {
 public:
  SensorHandle() = default;
  explicit SensorHandle(std::uint32_t index, const SensorInfo* info) : index_(index), info_(info) {}
  [[nodiscard]] bool valid() const noexcept { return info_ != nullptr; }
  [[nodiscard]] std::uint32_t index() const noexcept { return index_; }
  /// Name, mounting, rays and limits. The handle must be valid.
  [[nodiscard]] const SensorInfo& info() const noexcept { return *info_; }

 private:
  std::uint32_t index_ = 0;
  const SensorInfo* info_ = nullptr;
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

/// A communicator; looked up by name once.
class CommunicatorHandle {
 public:
  CommunicatorHandle() = default;
  explicit CommunicatorHandle(std::uint32_t index, const CommunicatorInfo* info)
      : index_(index), info_(info) {}
  [[nodiscard]] bool valid() const noexcept { return info_ != nullptr; }
  [[nodiscard]] std::uint32_t index() const noexcept { return index_; }
  /// Name and limits. The handle must be valid.
  [[nodiscard]] const CommunicatorInfo& info() const noexcept { return *info_; }

 private:
  std::uint32_t index_ = 0;
  const CommunicatorInfo* info_ = nullptr;
};

namespace detail {
template <class Record>
constexpr ReadingKind kind_of() noexcept;
template <>
constexpr ReadingKind kind_of<float>() noexcept {
  return ReadingKind::kRanges;
}
template <>
constexpr ReadingKind kind_of<Sighting>() noexcept {
  return ReadingKind::kSightings;
}
template <>
constexpr ReadingKind kind_of<PoseReading>() noexcept {
  return ReadingKind::kPose;
}
template <>
constexpr ReadingKind kind_of<OdometryReading>() noexcept {
  return ReadingKind::kOdometry;
}
template <>
constexpr ReadingKind kind_of<NeighbourReading>() noexcept {
  return ReadingKind::kNeighbours;
}
template <>
constexpr ReadingKind kind_of<ContactReading>() noexcept {
  return ReadingKind::kContact;
}
template <>
constexpr ReadingKind kind_of<VelocityReading>() noexcept {
  return ReadingKind::kVelocity;
}
template <>
constexpr ReadingKind kind_of<double>() noexcept {
  return ReadingKind::kValues;
}
}  // namespace detail

}  // namespace rave
