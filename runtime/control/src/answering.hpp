// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "rave/control/protocol.hpp"
#include "rave/control/run_control.hpp"

// What is answered is the same over the socket and over the bus.
namespace rave::control {

/// The answer to what needs no step of the run: status, pause, resume, single steps. Nothing: it
/// is for the run, as run_request() says. Any thread.
[[nodiscard]] std::optional<Answer> answer_at_once(runtime::RunControl& control,
                                                   const Request& request);

/// What the run says to a request.
[[nodiscard]] Answer answer_of(const Result<std::string>& result);

}  // namespace rave::control
