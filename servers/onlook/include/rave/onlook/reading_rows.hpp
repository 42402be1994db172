// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "rave/gui_server/source.hpp"
#include "rave/robot/reading.hpp"

namespace rave::gui_server {

/// What the numbers of a row are, such as `range [m]`; of kValues none, since only its driver
/// knows.
[[nodiscard]] std::vector<std::string> fields_of(ReadingKind kind);

/// Puts the records of a reading into rows of numbers. `count`: records. Too few bytes: what is
/// whole of them.
void fill_rows(ReadingKind kind, std::uint32_t count, std::span<const std::byte> records,
               ReadingAt& reading);

}  // namespace rave::gui_server
