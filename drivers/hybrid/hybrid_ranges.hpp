// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/robot/hybrid_sensor.hpp"

namespace rave {

/// Fuses the ranges of two lasers or sonars with the same rays; README.md has the rules. Immutable
/// after start(); any thread.
class HybridRanges final : public HybridSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kRanges;
  static constexpr const char* kRules[] = {"nearest", "occlusion"};
  static constexpr const char* kTooNear[] = {"range_min", "no_return", "invalid"};
  static constexpr ParamSpec kParams[] = {
      choice_param("rule", "nearest", kRules,
                   "nearest: the smaller range; occlusion: a virtual body counts only where it "
                   "would hide what the real sensor measured."),
      choice_param("too_near", "range_min", kTooNear,
                   "For occlusion: reading of the real sensor for a body nearer than its "
                   "range_min: range_min, no_return (+infinity) or invalid (NaN)."),
  };

  /// Error: kInvalidArgument if the halves do not have the same number of rays, or if the rule
  /// needs the range limits of the real half and it states none.
  Status start(const HybridSetup& setup) override;
  void fuse(const FuseItem& item) const override;

 private:
  [[nodiscard]] float nearest(float real_m, float virtual_m) const noexcept;
  [[nodiscard]] float occluded(float real_m, float virtual_m) const noexcept;

  bool occlusion_ = false;
  float too_near_m_ = 0;   ///< The reading for a body nearer than range_min_m_.
  float range_min_m_ = 0;  ///< Range limit of the real half.
  float range_max_m_ = 0;
};

}  // namespace rave
