// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/bus/request_book.hpp"
#include "rave/control/manager_relay.hpp"
#include "rave/control/run_control.hpp"

namespace rave::control {

/// A handler of the bus requests of a process. It treats them like requests at the control socket:
/// the same lines, the same answers. `relay`: of a host, for requests that it is to forward; null:
/// the process is the manager. Both must outlive the handler, which does not block and may be
/// called in the thread of the run.
[[nodiscard]] bus::BeginRequest bus_requests_of(runtime::RunControl& control,
                                                ManagerRelay* relay = nullptr);

}  // namespace rave::control
