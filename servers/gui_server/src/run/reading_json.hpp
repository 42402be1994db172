// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "rave/robot/reading.hpp"

namespace rave::gui_server {

/// Adds to a sensor of `roster` what its readings consist of: `kind`, `fields`, and `list` if each
/// row is a thing of its own.
void add_reading_type(nlohmann::ordered_json& sensor, ReadingKind kind);

}  // namespace rave::gui_server
