// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/bus/wish_book.hpp"
#include "rave/control/run_control.hpp"

namespace rave::control {

/// Lets a process do what it is asked on the bus as if it had been asked at its control socket: the
/// same lines, the same answers. `control` outlives what is returned, which waits for nothing and
/// may be called in the thread of the run.
[[nodiscard]] bus::BeginWish wishes_of(runtime::RunControl& control);

}  // namespace rave::control
