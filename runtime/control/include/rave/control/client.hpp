// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/control/protocol.hpp"

namespace rave::control {

/// Sends a request to a run on this machine, by name, and waits for the answer. Errors: kNotFound
/// (it has ended), kIo, kTimeout, kParse.
[[nodiscard]] Result<Answer> ask(const std::string& run, const Request& request);

}  // namespace rave::control
