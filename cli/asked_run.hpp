// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "bus_options.hpp"
#include "rave/base/result.hpp"
#include "rave/client/asked_run.hpp"

namespace rave::cli {

using client::AskedRun;
using client::complete;
using client::Reply;
using client::SeenRun;

/// Prints that a process refuses what it was asked, and why. Returns kNotGood.
int refused(const AskedRun& run, const std::string& why);

/// Asks a process and prints its answer. Returns the exit code.
[[nodiscard]] Result<int> ask_and_tell(const AskedRun& run, const control::Request& request);

}  // namespace rave::cli
