// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/bus/bus_options.hpp"

namespace rave::cli {

/// Members of commands have these types.
using bus::BusOptions;
using bus::kMostHosts;

}  // namespace rave::cli
