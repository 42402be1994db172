// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "rave/robot_host/run_control.hpp"
#include "rave/run_control/protocol.hpp"

// What is answered is the same over the socket and over the bus.
namespace rave::run_control {

/// The answer to what needs no step of the run: status, pause, resume, single steps. Nothing: it
/// is for the run, as run_request() says. Any thread.
[[nodiscard]] std::optional<Answer> answer_at_once(robot_host::RunControl& control,
                                                   const Request& request);

/// What the run says to a request.
[[nodiscard]] Answer answer_of(const Result<std::string>& result);

}  // namespace rave::run_control
