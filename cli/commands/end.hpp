// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bus_options.hpp"
#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave end`: ends a run, or hosts that have lost the manager of theirs.
struct EndCommand {
  std::string run;
  BusOptions bus;
};

/// Returns 0 if all that were asked end, 1 if one did not answer, 2 if there is no such run.
[[nodiscard]] Result<int> end_run(const EndCommand& options);

}  // namespace rave::cli
