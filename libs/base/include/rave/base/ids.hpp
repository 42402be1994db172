// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <limits>

namespace rave {

/// An index that cannot be mixed up with an index of another kind. Trivially copyable and 4 bytes,
/// so it may cross the plug-in interface.
template <class Tag>
class Id {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  constexpr Id() noexcept = default;
  constexpr explicit Id(std::uint32_t value) noexcept : value_(value) {}

  [[nodiscard]] constexpr std::uint32_t value() const noexcept { return value_; }
  [[nodiscard]] constexpr bool valid() const noexcept { return value_ != kNone; }

  friend constexpr bool operator==(Id, Id) noexcept = default;
  friend constexpr auto operator<=>(Id, Id) noexcept = default;

 private:
  std::uint32_t value_ = kNone;
};

/// A robot: its index in the expanded scenario, the same in every process and in every run.
using RobotId = Id<struct RobotTag>;
/// A sensor, actuator, controller or program slot of one robot: its index in that robot's file.
using DeviceId = Id<struct DeviceTag>;

}  // namespace rave

template <class Tag>
struct std::hash<rave::Id<Tag>> {
  std::size_t operator()(rave::Id<Tag> id) const noexcept { return id.value(); }
};
