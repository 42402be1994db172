// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rave/robot/processing.hpp"

namespace rave::detail {

/// The filters of range sensors: what FieldFilter does with each field, for all rays at once, in
/// vector instructions. `capacity`: rays of a sample at most.

/// Bytes that a filter remembers, a multiple of 8.
[[nodiscard]] std::size_t range_filter_memory(const FilterSpec& filter,
                                              std::uint32_t capacity) noexcept;

/// Forgets all rays.
void reset_range_filter(const FilterSpec& filter, std::uint32_t capacity,
                        std::byte* memory) noexcept;

/// Puts `ranges_m`, the first rays of a sample, through the filter. Rays beyond them stay as they
/// are in its memory.
void filter_ranges(const FilterSpec& filter, std::uint32_t capacity, std::int64_t stamp_ns,
                   std::span<float> ranges_m, std::byte* memory) noexcept;

}  // namespace rave::detail
