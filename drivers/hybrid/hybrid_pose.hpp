// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/robot/hybrid_sensor.hpp"

namespace rave {

/// Fuses two poses in one frame; README.md has the formula. Immutable after start(); any thread.
class HybridPose final : public HybridSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kPose;
  static constexpr const char* kRules[] = {"weighted"};
  static constexpr ParamSpec kParams[] = {
      choice_param("rule", "weighted", kRules, "weighted: by inverse variance."),
      number_param(
          "real_sigma_xy_m", "m", 0, 0, 1e6,
          "Standard deviation of x and of y of the real half; 0: the value of each reading."),
      number_param("real_sigma_yaw_deg", "deg", 0, 0, 1e6,
                   "Standard deviation of the yaw of the real half; 0: the value of each reading."),
      number_param(
          "virtual_sigma_xy_m", "m", 0, 0, 1e6,
          "Standard deviation of x and of y of the virtual half; 0: the value of each reading."),
      number_param(
          "virtual_sigma_yaw_deg", "deg", 0, 0, 1e6,
          "Standard deviation of the yaw of the virtual half; 0: the value of each reading."),
  };

  Status start(const HybridSetup& setup) override;
  /// Throws std::runtime_error if a half states no variance and no parameter does.
  void fuse(const FuseItem& item) const override;

 private:
  /// Variances of one half from its parameters; 0: those of the readings.
  struct Stated {
    const char* half = "";
    double xy_m2 = 0;
    double yaw_rad2 = 0;
  };
  [[nodiscard]] static PoseReading with_variance(const PoseReading& reading, const Stated& stated);

  Stated real_{"real"};
  Stated imagined_{"virtual"};
};

}  // namespace rave
