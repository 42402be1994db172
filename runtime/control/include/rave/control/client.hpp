// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/control/protocol.hpp"

namespace rave::control {

/// Asks a run by its name and waits for the answer. Errors: kNotFound (it is gone), kIo, kTimeout,
/// kParse.
[[nodiscard]] Result<Answer> ask(const std::string& run, const Request& request);

}  // namespace rave::control
