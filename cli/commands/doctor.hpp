// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bus_options.hpp"

namespace rave::cli {

/// `rave doctor`.
struct DoctorCommand {
  BusOptions bus;
  bool listen = false;
  bool json = false;
};

/// Looks for what keeps machines apart. Returns 0 if nothing was found, 1 if something was, 2 on
/// bad input.
[[nodiscard]] int doctor(const DoctorCommand& options);

}  // namespace rave::cli
