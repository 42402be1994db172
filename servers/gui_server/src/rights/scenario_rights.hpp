// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/config/gui_file.hpp"
#include "rave/gui_server/rights.hpp"

namespace rave::gui_server {

/// The usual rights with what a scenario changes.
[[nodiscard]] Rights rights_of(const config::GuiFile& gui);

}  // namespace rave::gui_server
