// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/web/message.hpp"

namespace rave::direct_line {

/// The page for a person who opens the address of a line in a browser; reaching it means that the
/// browser trusts the certificate. `host` is the name of the host in the scenario.
[[nodiscard]] web::Response explain_page(const std::string& host);

}  // namespace rave::direct_line
