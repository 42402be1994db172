// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/live_testing/live_plugin.hpp"

namespace rave::testing {

namespace detail {
/// A base class that owns the plug-in, so that it is constructed before LiveSensor.
struct OwnPlugin {
  explicit OwnPlugin(const std::string& name) : own_plugin(name) {}
  LivePlugin own_plugin;
};
}  // namespace detail

/// A sensor driver in a plug-in of the same name.
class LiveDriver : private detail::OwnPlugin, public LiveSensor {
 public:
  explicit LiveDriver(const std::string& name)
      : detail::OwnPlugin(name), LiveSensor(own_plugin, name) {}
};

}  // namespace rave::testing
