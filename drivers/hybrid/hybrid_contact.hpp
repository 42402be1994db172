// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/robot/hybrid_sensor.hpp"

namespace rave {

/// Fuses two bumpers; README.md has the rule. Immutable; any thread.
class HybridContact final : public HybridSensor {
 public:
  static constexpr ReadingKind kReading = ReadingKind::kContact;
  static constexpr const char* kRules[] = {"either"};
  static constexpr ParamSpec kParams[] = {
      choice_param("rule", "either", kRules,
                   "either: contact if one of the halves reports contact."),
  };

  Status start(const HybridSetup& setup) override;
  void fuse(const FuseItem& item) const override;

 private:
  std::uint32_t capacity_ = 1;  ///< Capacity of the real half and of the result.
};

}  // namespace rave
