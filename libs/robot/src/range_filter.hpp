// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rave/robot/processing.hpp"

namespace rave::detail {

/// The filters of range sensors: like FieldFilter for each ray, but for all rays at once with
/// vector instructions. `capacity`: the largest number of rays.

/// Size of a filter's state in bytes, a multiple of 8.
[[nodiscard]] std::size_t range_filter_memory(const FilterSpec& filter,
                                              std::uint32_t capacity) noexcept;

/// Clears the state of all rays.
void reset_range_filter(const FilterSpec& filter, std::uint32_t capacity,
                        std::byte* memory) noexcept;

/// Filters `ranges_m`, the first rays of a sample. The states of other rays do not change.
void filter_ranges(const FilterSpec& filter, std::uint32_t capacity, std::int64_t stamp_ns,
                   std::span<float> ranges_m, std::byte* memory) noexcept;

}  // namespace rave::detail
