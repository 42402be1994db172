// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "rave/robot/processing.hpp"

namespace rave::detail {

/// The doubles of a record that filters process: `count` of them from its start. 0: a kind that
/// cannot be filtered. Ranges have filters of their own (range_filter.hpp).
struct FilterFields {
  std::uint32_t count = 0;
  std::uint32_t angles = 0;  ///< Bit i: number i is an angle.
};

[[nodiscard]] FilterFields filter_fields(ReadingKind kind) noexcept;

/// Size of a filter's state for one field in bytes, a multiple of 8; initially zero.
[[nodiscard]] std::size_t filter_memory(const FilterSpec& filter) noexcept;

/// Filters one field of a sample.
class FieldFilter {
 public:
  explicit FieldFilter(const FilterSpec& filter) noexcept : filter_(filter) {}

  [[nodiscard]] double operator()(double x, std::int64_t stamp_ns, bool angle,
                                  std::byte* memory) noexcept;

 private:
  [[nodiscard]] double median(double x, bool angle, std::byte* memory) const noexcept;
  [[nodiscard]] double exponential(double x, std::int64_t stamp_ns, bool angle,
                                   std::byte* memory) noexcept;

  const FilterSpec& filter_;
  std::int64_t dt_ns_ = 0;  // the dt of gain_: the fields of a sample share it
  double gain_ = 0;
};

}  // namespace rave::detail
