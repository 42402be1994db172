// SPDX-License-Identifier: Apache-2.0
// Filters for ranges, by column: the same place of all rays lies together, so that vector
// instructions treat many rays at once.
#include "range_filter.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "range_kernel.hpp"
#include "rave/math/scalar.hpp"

namespace rave::detail {
namespace {

std::size_t whole_words(std::size_t bytes) { return (bytes + 7) / 8 * 8; }

/// Ranges as integers in the same order: NaN after infinity, and after that empty places of the
/// window.
using Rank = std::int32_t;
constexpr Rank kEmpty = std::numeric_limits<Rank>::max();
constexpr Rank kNoNumber = kEmpty - 1;

// Integers have one order for all values, NaN included, and vector instructions have minimum and
// maximum of them.
Rank rank_of(float x) noexcept {
  const auto bits = std::bit_cast<Rank>(x);
  // The bits of negative floats decrease as their values increase.
  return x != x ? kNoNumber : bits ^ ((bits >> 31) & kEmpty);
}
float range_of(Rank rank) noexcept {
  if (rank == kNoNumber) return std::numeric_limits<float>::quiet_NaN();
  return std::bit_cast<float>(rank ^ ((rank >> 31) & kEmpty));
}

/// The last readings of each ray, in order of arrival and sorted.
struct MedianMemory {
  MedianMemory(std::byte* memory, std::uint32_t rays, std::uint32_t window) noexcept
      : filled(reinterpret_cast<std::uint32_t*>(memory)),
        next(filled + rays),
        history(reinterpret_cast<Rank*>(next + rays)),
        sorted(history + std::size_t{rays} * window) {}

  std::uint32_t* filled;
  std::uint32_t* next;
  Rank* history;  ///< A ring of the window's length for each ray.
  Rank* sorted;   ///< The smallest of all rays first, then the second smallest, ...
};

constexpr std::uint32_t kRow = 64;
using Row = std::array<Rank, kRow>;

void median(std::uint32_t window, std::uint32_t capacity, std::span<float> ranges_m,
            std::byte* memory) noexcept {
  const MedianMemory own(memory, capacity, window);
  Row old;
  Row fresh;
  Row below;
  for (std::uint32_t first = 0; first < ranges_m.size(); first += kRow) {
    const auto count =
        static_cast<std::uint32_t>(std::min<std::size_t>(kRow, ranges_m.size() - first));
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t ray = first + i;
      Rank& place = own.history[std::size_t{ray} * window + own.next[ray]];
      old[i] = place;
      fresh[i] = rank_of(ranges_m[ray]);
      place = fresh[i];
      own.next[ray] = own.next[ray] + 1 == window ? 0 : own.next[ray] + 1;
      own.filled[ray] = std::min(own.filled[ray] + 1, window);
    }
    // The oldest value of each window leaves its sorted row and the new one enters, for up to 64
    // rays at once. A full sort for each sample would take far longer.
    exchange_in_order(own.sorted + first, capacity, window, count,
                      {old.data(), fresh.data(), below.data()});
    for (std::uint32_t ray = first; ray < first + count; ++ray) {
      const std::size_t middle = (own.filled[ray] - 1) / 2;
      ranges_m[ray] = range_of(own.sorted[middle * capacity + ray]);
    }
  }
}

/// The last output of each ray, NaN if none, and the stamp of its last sample.
struct ExponentialMemory {
  ExponentialMemory(std::byte* memory, std::uint32_t rays) noexcept
      : output(reinterpret_cast<double*>(memory)),
        stamp_ns(reinterpret_cast<std::int64_t*>(output + rays)) {}

  double* output;
  std::int64_t* stamp_ns;
};

double gain_of(std::int64_t dt_ns, double time_constant_s) noexcept {
  return 1.0 - exp(-static_cast<double>(dt_ns) * 1e-9 / time_constant_s);
}

void exponential(double time_constant_s, std::uint32_t capacity, std::int64_t stamp_ns,
                 std::span<float> ranges_m, std::byte* memory) noexcept {
  const ExponentialMemory own(memory, capacity);
  // Rays with equal earlier stamps are processed together: usually all of them.
  for (std::size_t first = 0; first < ranges_m.size();) {
    // Rays differ only if an earlier sample had fewer ranges than this one.
    const std::int64_t before_ns = own.stamp_ns[first];
    std::size_t last = first;
    for (; last < ranges_m.size() && own.stamp_ns[last] == before_ns; ++last) {
      own.stamp_ns[last] = stamp_ns;
    }
    blend_ranges(ranges_m.data() + first, last - first,
                 gain_of(stamp_ns - before_ns, time_constant_s), own.output + first);
    first = last;
  }
}

std::uint32_t window_of(const FilterSpec& filter) {
  return static_cast<std::uint32_t>(filter.window);
}

}  // namespace

std::size_t range_filter_memory(const FilterSpec& filter, std::uint32_t capacity) noexcept {
  const std::size_t rays = capacity;
  if (filter.kind == FilterSpec::Kind::kExponential) {
    return rays * (sizeof(double) + sizeof(std::int64_t));
  }
  return whole_words(rays * (2 * sizeof(std::uint32_t) + 2 * window_of(filter) * sizeof(Rank)));
}

void reset_range_filter(const FilterSpec& filter, std::uint32_t capacity,
                        std::byte* memory) noexcept {
  if (filter.kind == FilterSpec::Kind::kExponential) {
    const ExponentialMemory own(memory, capacity);
    std::fill_n(own.output, capacity, std::numeric_limits<double>::quiet_NaN());
    std::fill_n(own.stamp_ns, capacity, std::int64_t{0});
    return;
  }
  const std::uint32_t window = window_of(filter);
  const MedianMemory own(memory, capacity, window);
  std::fill_n(own.filled, std::size_t{2} * capacity, 0U);
  std::fill_n(own.history, std::size_t{2} * capacity * window, kEmpty);
}

void filter_ranges(const FilterSpec& filter, std::uint32_t capacity, std::int64_t stamp_ns,
                   std::span<float> ranges_m, std::byte* memory) noexcept {
  if (filter.kind == FilterSpec::Kind::kExponential) {
    exponential(filter.time_constant_s, capacity, stamp_ns, ranges_m, memory);
  } else {
    median(window_of(filter), capacity, ranges_m, memory);
  }
}

}  // namespace rave::detail
