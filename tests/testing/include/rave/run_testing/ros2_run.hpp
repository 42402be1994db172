// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rave/live_testing/scenario_run.hpp"

namespace rave::tests {

/// Tests of several processes at once must not meet; there is no tag in ROS 2.
inline int ros2_domain() { return 1 + static_cast<int>(::getpid()) % 90; }

using testing::RaveRun;

/// With a peer of ROS 2.
class Ros2Run : public testing::ScenarioRun {
 public:
  Ros2Run() : ScenarioRun("ros2_run") {}

  void start_peer(const std::string& program, std::vector<std::string> options) {
    options.insert(options.end(), {"--domain", std::to_string(ros2_domain())});
    peer = std::make_unique<testing::PeerProcess>(program, options);
  }
  void start(const std::string& scenario) {
    write("scenario.yaml", scenario);
    ScenarioRun::start();
  }
};

}  // namespace rave::tests
