// SPDX-License-Identifier: Apache-2.0
// Filters for single numbers and angles, one state per field.
#include "field_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "rave/math/scalar.hpp"
#include "rave/robot/reading_type.hpp"

namespace rave::detail {
namespace {

constexpr std::size_t kLargestWindow = 99;

/// Followed by `window` doubles, a ring of the last readings.
struct MedianState {
  double output = 0;
  std::uint32_t filled = 0;
  std::uint32_t next = 0;
};

struct ExponentialState {
  double output = 0;
  std::int64_t stamp_ns = 0;
  std::uint32_t valid = 0;
  std::uint32_t reserved = 0;
};

/// Orders numbers first, then NaN: a total order even for readings of a faulty device.
bool before(double a, double b) noexcept {
  if (std::isnan(a)) return false;
  return std::isnan(b) || a < b;
}

}  // namespace

FilterFields filter_fields(ReadingKind kind) noexcept {
  FilterFields found;
  for (const ReadingField& field : reading_type(kind).fields) {
    if (!field.filtered) break;
    if (field.noise == NoiseTerm::kAngle) found.angles |= 1U << found.count;
    ++found.count;
  }
  return found;
}

std::size_t filter_memory(const FilterSpec& filter) noexcept {
  if (filter.kind == FilterSpec::Kind::kExponential) return sizeof(ExponentialState);
  return sizeof(MedianState) + static_cast<std::size_t>(filter.window) * sizeof(double);
}

double FieldFilter::operator()(double x, std::int64_t stamp_ns, bool angle,
                               std::byte* memory) noexcept {
  if (filter_.kind == FilterSpec::Kind::kExponential) {
    return exponential(x, stamp_ns, angle, memory);
  }
  return median(x, angle, memory);
}

double FieldFilter::median(double x, bool angle, std::byte* memory) const noexcept {
  auto& own = *reinterpret_cast<MedianState*>(memory);
  auto* const history = reinterpret_cast<double*>(memory + sizeof(MedianState));
  const auto window = static_cast<std::uint32_t>(filter_.window);
  if (own.filled == 0) own.output = x;
  history[own.next] = x;
  own.next = (own.next + 1) % window;
  own.filled = std::min(own.filled + 1, window);

  std::array<double, kLargestWindow> sorted;
  for (std::uint32_t i = 0; i < own.filled; ++i) {
    // Angles relative to the last output, so that the wrap from pi to -pi is not a jump.
    sorted[i] = angle ? wrap_angle(history[i] - own.output) : history[i];
  }
  // Of an even number the lower one: the output is always a reading that was made.
  auto* const middle = sorted.data() + (own.filled - 1) / 2;
  std::nth_element(sorted.data(), middle, sorted.data() + own.filled, before);
  own.output = angle ? wrap_angle(own.output + *middle) : *middle;
  return own.output;
}

double FieldFilter::exponential(double x, std::int64_t stamp_ns, bool angle,
                                std::byte* memory) noexcept {
  auto& own = *reinterpret_cast<ExponentialState*>(memory);
  // No return ends the mean: it must not pull a later obstacle away, nor be pulled near by an
  // earlier one.
  if (!std::isfinite(x)) {
    own = {};
    return x;
  }
  if (own.valid == 0) {
    own = {x, stamp_ns, 1, 0};
    return x;
  }
  const std::int64_t dt_ns = stamp_ns - own.stamp_ns;
  // The exponential is computed again only when the interval changes, which it hardly does.
  if (dt_ns != dt_ns_) {
    dt_ns_ = dt_ns;
    gain_ = 1.0 - exp(-static_cast<double>(dt_ns) * 1e-9 / filter_.time_constant_s);
  }
  // First-order low pass for any interval: gain 1 - exp(-dt/T).
  own.output = angle ? wrap_angle(own.output + gain_ * wrap_angle(x - own.output))
                     : own.output + gain_ * (x - own.output);
  own.stamp_ns = stamp_ns;
  return own.output;
}

}  // namespace rave::detail
