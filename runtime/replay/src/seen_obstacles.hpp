// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "rave/codec/raw_node.hpp"
#include "rave/config/robot_devices.hpp"
#include "rave/config/world_file.hpp"

namespace rave::replay {

/// Which range sensors that are played had sensed the virtual obstacles of the recorded run. For
/// the played robots such obstacles are walls of the real floor: their readings contain them, so
/// the virtual half of a hybrid sensor must not sense them once more.
class SeenObstacles {
 public:
  /// Notes a range sensor that is played, as the recorded run had it.
  void note(const std::string& robot, const config::SensorFile& sensor, bool is_virtual);

  /// Puts the obstacles of the world on the layer `mapped_real` if all noted sensors had sensed
  /// them. Returns a sentence for the user; empty if nothing was to be done.
  [[nodiscard]] std::string put_on_layer(config::WorldFile& world);
  /// The same for what `changes:` adds later.
  void put_on_layer(codec::RawNode& changes) const;

 private:
  [[nodiscard]] bool all_saw() const { return !saw_.empty() && missed_.empty(); }

  std::string saw_;     ///< `robot/sensor` of the first that sensed them; empty: none did.
  std::string missed_;  ///< Of the first that did not.
};

}  // namespace rave::replay
