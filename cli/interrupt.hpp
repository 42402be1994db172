// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/control/run_control.hpp"

namespace rave::cli {

/// The control of the run of this process, ended by the first SIGINT or SIGTERM from now on; a
/// second signal kills. One for the whole process.
[[nodiscard]] runtime::RunControl& ended_by_signals();

}  // namespace rave::cli
