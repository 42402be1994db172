// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/codec/raw_node.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::cli {

/// The description of a driver, for other programs.
[[nodiscard]] codec::RawNode driver_json(const plugin::Driver& driver);

}  // namespace rave::cli
