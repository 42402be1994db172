// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "bus_options.hpp"
#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave top`.
struct TopCommand {
  std::string run;  ///< Empty: the only one.
  bool once = false;
  bool json = false;
  bool robots = false;
  std::optional<double> interval_s;
  BusOptions bus;
};

/// Shows live statistics of a run until it is interrupted. Returns 0; 2 if there is no such run.
[[nodiscard]] Result<int> top(const TopCommand& options);

}  // namespace rave::cli
