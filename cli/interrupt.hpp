// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/robot_host/run_control.hpp"

namespace rave::cli {

/// The control of the run of this process, ended by the first SIGINT or SIGTERM from now on; a
/// second signal kills. One for the whole process.
[[nodiscard]] robot_host::RunControl& ended_by_signals();

}  // namespace rave::cli
