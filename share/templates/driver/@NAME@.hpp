// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rave/sim/virtual_sensor.hpp>

/// A virtual sensor that reads how far it is from a beacon. One object serves all robots.
class @CLASS@ : public rave::VirtualSensor {
 public:
  static constexpr rave::ReadingKind kReading = rave::ReadingKind::kValues;

  rave::Status configure(const rave::VirtualSensorSetup& setup,
                         rave::VirtualDeclaration& declaration) override;
  void sample(const rave::WorldView& world, const rave::SampleItem& item) const override;

 private:
  rave::Vec2 p_WB_;  // The beacon.
};
