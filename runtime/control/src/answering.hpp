// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "rave/control/protocol.hpp"
#include "rave/control/run_control.hpp"

// The answers are the same over the socket and over the bus.
namespace rave::control {

/// The answer to requests that need no step of the run: status, pause, resume, single steps. Empty
/// for requests to the run; `run`. May be called from any thread.
[[nodiscard]] std::optional<Answer> answer_at_once(runtime::RunControl& control,
                                                   const Request& request);

/// The answer made from the run's result of a request.
[[nodiscard]] Answer answer_of(const Result<std::string>& result);

}  // namespace rave::control
