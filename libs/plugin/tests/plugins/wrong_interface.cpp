// SPDX-License-Identifier: Apache-2.0
// A plug-in whose stamp says that it was built for another interface. Its initialiser ends the
// process that loads it, so that a test notices a host that loads before it checks.
#include <cstdlib>

#include "rave/robot/plugin_entry.hpp"

namespace {
__attribute__((constructor)) void end_the_process() { std::_Exit(99); }
}  // namespace

RAVE_PLUGIN_WITH_STAMP_(::rave::plugin::make_stamp(1, 0, "from_another_age")) {}
