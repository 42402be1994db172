// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/web/message.hpp"

namespace rave::direct_line {

/// What a browser shows that was led to the address of a line: who comes this far trusts its
/// certificate. `host`: the name of the host in the scenario.
[[nodiscard]] web::Response explain_page(const std::string& host);

}  // namespace rave::direct_line
