// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/bus/config.hpp"
#include "rave/bus/run_id.hpp"

namespace rave::cli_test {

/// The bus of a test's run, for this process. `apart`: the words that keep it apart from others.
[[nodiscard]] inline bus::BusConfig bus_of(const bus::RunId& run, const std::string& name,
                                           const std::vector<std::string>& apart) {
  bus::BusConfig config;
  config.participant = name;
  config.run = run;
  config.max_processes = 100;
  for (std::size_t i = 0; i + 1 < apart.size(); ++i) {
    if (apart[i] == "--bus-tag") config.tag = apart[i + 1];
    if (apart[i] == "--domain") {
      config.domain = static_cast<std::uint32_t>(std::stoul(apart[i + 1]));
    }
  }
  return config;
}

}  // namespace rave::cli_test
