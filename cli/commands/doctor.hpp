// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bus_options.hpp"
#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave doctor`.
struct DoctorCommand {
  BusOptions bus;
  bool listen = false;
  bool json = false;
};

/// Searches for the reasons why machines do not find each other. Returns 0 if there are none, 1 if
/// there are, 2 on bad input.
[[nodiscard]] Result<int> doctor(const DoctorCommand& options);

}  // namespace rave::cli
