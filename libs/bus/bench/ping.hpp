// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace rave::bus::bench {

/// Who takes the sample: a thread that a wait set wakes, as all of RAVE does it, or the thread of
/// Cyclone DDS that received it, for comparison; or the former by the local transport.
enum class Way { kWaitSet, kListener, kShort };

/// Answers packets of the run until one says that it is the last. For a process of its own.
int serve_bus(const std::string& run, Way way);

/// Measures `count` round trips by UDP and each way of the bus, in turns, and prints JSON.
int ping(std::size_t count);

}  // namespace rave::bus::bench
