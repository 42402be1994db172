// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bus_options.hpp"

namespace CLI {  // its own name. NOLINT(readability-identifier-naming)
class App;
}

namespace rave::cli {

/// Adds the options with which a process reaches others: domain, interface, peers, multicast,
/// certificates.
void add_network_options(CLI::App& app, BusOptions& c);

/// Adds the same options and the name of the run.
void add_bus_options(CLI::App& app, BusOptions& c);

}  // namespace rave::cli
