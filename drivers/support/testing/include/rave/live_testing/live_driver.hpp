// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/live_testing/live_plugin.hpp"

namespace rave::testing {

namespace detail {
/// Made before the instance that comes from it.
struct OwnPlugin {
  explicit OwnPlugin(const std::string& name) : own_plugin(name) {}
  LivePlugin own_plugin;
};
}  // namespace detail

/// A sensor driver that is alone in a plug-in of its name.
class LiveDriver : private detail::OwnPlugin, public LiveSensor {
 public:
  explicit LiveDriver(const std::string& name)
      : detail::OwnPlugin(name), LiveSensor(own_plugin, name) {}
};

}  // namespace rave::testing
