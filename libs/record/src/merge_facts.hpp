// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "rave/record/mcap_reader.hpp"

namespace rave::record {

/// The entries of a record that have this name; empty if there are none or they cannot be read.
[[nodiscard]] StringMap metadata_of(const McapReader& reader, std::string_view name);

}  // namespace rave::record
