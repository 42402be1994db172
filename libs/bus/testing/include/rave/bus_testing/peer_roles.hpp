// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "rave/bus/bus.hpp"

namespace rave::bus::testing {

/// `name=value` words of the command line.
using Arguments = std::map<std::string, std::string>;

/// Plays a role until the standard input is closed; what it says on the standard output, a line
/// each, is for the test. False if there is no such role.
bool play(const std::string& role, Bus& bus, const Arguments& arguments);

}  // namespace rave::bus::testing
