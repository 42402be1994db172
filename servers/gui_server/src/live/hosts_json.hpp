// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/watch/run_view.hpp"

namespace rave::gui_server {

/// The processes of a run as the array `hosts` of the message with that name, in the words of `rave
/// top`. What is not known is null or missing.
[[nodiscard]] std::string hosts_json(const watch::RunView& view);

}  // namespace rave::gui_server
