// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rave/robot/reading.hpp"

namespace rave::onlook {

/// Number of values per row, one for each column of the reading_type(); 0 for kNone.
[[nodiscard]] std::uint32_t field_count(ReadingKind kind) noexcept;

/// Appends the records of a reading to `values` as rows; returns the number of rows. `count`:
/// number of records. If there are too few bytes, only complete records are used.
std::uint32_t add_rows(ReadingKind kind, std::uint32_t count, std::span<const std::byte> records,
                       std::vector<float>& values);

}  // namespace rave::onlook
