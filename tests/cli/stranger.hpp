// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rave/bus/bus.hpp"

namespace rave::cli_test {

/// The bus of a run of the test, for somebody whom nobody knows. `apart`: what
/// SharedWorld::apart() says.
[[nodiscard]] inline bus::BusConfig stranger_config(const std::vector<std::string>& apart,
                                                    const bus::RunId& run) {
  bus::BusConfig config;
  config.participant = "stranger";
  config.run = run;
  config.max_processes = 114;
  config.tag = apart[1];
  config.domain = static_cast<std::uint32_t>(std::stoul(apart[3]));
  return config;
}

/// This process on that bus.
[[nodiscard]] inline Result<std::unique_ptr<bus::Bus>> open_stranger(
    const std::vector<std::string>& apart, const bus::RunId& run) {
  return bus::Bus::open(stranger_config(apart, run));
}

}  // namespace rave::cli_test
