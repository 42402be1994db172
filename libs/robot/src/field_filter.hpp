// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "rave/robot/processing.hpp"

namespace rave::detail {

/// The doubles in a record that filters work on: `count` of them from the start of the record. 0: a
/// kind that cannot be filtered. Ranges have filters of their own (range_filter.hpp).
struct FilterFields {
  std::uint32_t count = 0;
  std::uint32_t angle = UINT32_MAX;  ///< Which of them is an angle.
};

[[nodiscard]] FilterFields filter_fields(ReadingKind kind) noexcept;

/// Bytes that a filter remembers of one field, a multiple of 8; all zero at the start.
[[nodiscard]] std::size_t filter_memory(const FilterSpec& filter) noexcept;

/// The reading `x` of one field at `stamp_ns` through one filter.
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
  std::int64_t dt_ns_ = 0;  // for which gain_ was computed: the fields of a sample share it
  double gain_ = 0;
};

}  // namespace rave::detail
