// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "rave/math/scalar.hpp"

namespace rave {

/// A set of directions about a robot: 64 sectors of 5.6 degrees, counter-clockwise from straight
/// ahead. A value.
class Sectors {
 public:
  static constexpr int kCount = 64;
  static constexpr double kWidth_rad = 2 * kPi / kCount;

  constexpr Sectors() = default;
  /// All that lie in an interval of directions, wholly or in part; at least the one that has
  /// `from_rad`. Needs `from_rad` <= `to_rad`.
  [[nodiscard]] static Sectors between(double from_rad, double to_rad) noexcept {
    Sectors sectors;
    const double first = std::floor(from_rad / kWidth_rad);
    const double count = std::clamp(std::ceil(to_rad / kWidth_rad) - first, 1.0, double{kCount});
    const int begin = static_cast<int>(std::fmod(first, kCount)) + kCount;
    for (int i = 0; i < static_cast<int>(count); ++i) {
      sectors.bits_ |= std::uint64_t{1} << ((begin + i) % kCount);
    }
    return sectors;
  }
  /// The directions within `half_rad` of straight ahead.
  [[nodiscard]] static Sectors ahead(double half_rad) noexcept {
    return between(-half_rad, half_rad);
  }
  /// The directions within `half_rad` of straight behind.
  [[nodiscard]] static Sectors behind(double half_rad) noexcept {
    return between(kPi - half_rad, kPi + half_rad);
  }

  [[nodiscard]] constexpr bool any() const noexcept { return bits_ != 0; }
  [[nodiscard]] constexpr bool has(int sector) const noexcept {
    return (bits_ >> sector & 1U) != 0;
  }
  /// Direction of the middle of a sector, in (-pi, pi].
  [[nodiscard]] static double middle_rad(int sector) noexcept {
    return wrap_angle((sector + 0.5) * kWidth_rad);
  }

  constexpr Sectors& operator|=(Sectors other) noexcept {
    bits_ |= other.bits_;
    return *this;
  }
  friend constexpr Sectors operator&(Sectors a, Sectors b) noexcept {
    a.bits_ &= b.bits_;
    return a;
  }
  /// Those of `a` that are not in `b`.
  friend constexpr Sectors operator-(Sectors a, Sectors b) noexcept {
    a.bits_ &= ~b.bits_;
    return a;
  }
  friend constexpr bool operator==(Sectors, Sectors) = default;

 private:
  std::uint64_t bits_ = 0;
};

/// In which directions the range sensors of a robot are blind: they have rays there, and every one
/// of them is NaN. A direction without rays is not blind; the robot was built so. A value.
class Sight {
 public:
  void clear() noexcept { *this = {}; }
  /// One ray or cone, and what it measured.
  void add(Sectors sectors, float range_m) noexcept {
    (std::isnan(range_m) ? looked_ : seen_) |= sectors;
  }
  [[nodiscard]] Sectors blind() const noexcept { return looked_ - seen_; }

 private:
  Sectors looked_;
  Sectors seen_;
};

/// A robot that drives ahead, or back, must see this far to either side of its way. What lies
/// farther to the side was ahead before it came there.
inline constexpr double kMustSee_rad = 0.25 * kPi;

}  // namespace rave
