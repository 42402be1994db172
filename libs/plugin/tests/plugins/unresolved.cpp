// SPDX-License-Identifier: Apache-2.0
// A plug-in that was linked without a library that it needs.
#include "rave/robot/plugin_entry.hpp"

namespace missing_library {
void missing_function(int argument);
}

RAVE_PLUGIN("unresolved") { missing_library::missing_function(1); }
