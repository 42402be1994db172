// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/result.hpp"

namespace rave::isolation {

/// Sets the handlers that tell the host by `socket` where the plug-in `plugin_file` crashed
/// (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT; ends the process) or is (kWhereSignal).
/// Once per process, before the plug-in is loaded. Errors: kIo.
[[nodiscard]] Status install_crash_report(int socket);

/// Notes where the plug-in that holds `function` lies in memory and reads its debug information,
/// so that little is left to do when it crashes.
void learn_plugin(const void* function);

}  // namespace rave::isolation
