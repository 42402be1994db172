// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rave/robot/reading.hpp"

namespace rave::onlook {

/// What the numbers of a row are, such as `range [m]`; of kValues none, since only its driver
/// knows.
[[nodiscard]] std::vector<std::string> fields_of(ReadingKind kind);

/// How many numbers a row has; 0 of kNone.
[[nodiscard]] std::uint32_t field_count(ReadingKind kind) noexcept;

/// Puts the records of a reading behind `values` as rows of numbers, and returns how many rows.
/// `count`: records. Too few bytes: what is whole of them.
std::uint32_t add_rows(ReadingKind kind, std::uint32_t count, std::span<const std::byte> records,
                       std::vector<float>& values);

}  // namespace rave::onlook
