// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/live_testing/live_plugin.hpp"

namespace rave::testing {

/// A sensor driver that is alone in a plug-in of its name.
class LiveDriver : private LivePlugin, public LiveSensor {
 public:
  explicit LiveDriver(const std::string& name) : LivePlugin(name), LiveSensor(*this, name) {}
  using LiveSensor::info;
};

}  // namespace rave::testing
