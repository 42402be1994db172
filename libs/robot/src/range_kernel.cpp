// SPDX-License-Identifier: Apache-2.0
#include "range_kernel.hpp"

#include <limits>

// Highway compiles this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/range_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rave::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr float kLargest = std::numeric_limits<float>::max();

/// Calls `loop(tag, i)` for vectors of values from i on, the longest possible first, then shorter
/// ones for the rest: nothing beyond `count` is read or written.
template <class Value, class Loop>
HWY_INLINE void for_all(std::size_t count, const Loop& loop) {
  const hn::CappedTag<Value, 64 / sizeof(Value)> wide;
  const hn::CappedTag<Value, 16 / sizeof(Value)> narrow;
  const hn::CappedTag<Value, 1> single;
  std::size_t i = 0;
  for (; i + hn::Lanes(wide) <= count; i += hn::Lanes(wide)) loop(wide, i);
  for (; i + hn::Lanes(narrow) <= count; i += hn::Lanes(narrow)) loop(narrow, i);
  for (; i < count; ++i) loop(single, i);
}

// NaN compares false, so it is not finite either.
template <class D, class V>
HWY_INLINE hn::Mask<D> is_finite(D d, V x) {
  return hn::Le(hn::Abs(x), hn::Set(d, kLargest));
}

void scatter(float* ranges, std::size_t count, float sigma, const float* normals) {
  for_all<float>(count, [&](auto d, std::size_t i) HWY_ATTR {
    const auto x = hn::LoadU(d, ranges + i);
    const auto wrong = hn::Add(x, hn::Mul(hn::Set(d, sigma), hn::LoadU(d, normals + i)));
    const auto bounded = hn::IfThenZeroElse(hn::Lt(wrong, hn::Zero(d)), wrong);
    hn::StoreU(hn::IfThenElse(is_finite(d, x), bounded, x), d, ranges + i);
  });
}

void limit(float* ranges, std::size_t count, float min, float max) {
  constexpr float kNothing = std::numeric_limits<float>::infinity();
  for_all<float>(count, [&](auto d, std::size_t i) HWY_ATTR {
    const auto x = hn::LoadU(d, ranges + i);
    const auto least = hn::Set(d, min);
    const auto near = hn::IfThenElse(hn::Lt(x, least), least, x);
    const auto far = hn::IfThenElse(hn::Gt(x, hn::Set(d, max)), hn::Set(d, kNothing), near);
    hn::StoreU(hn::IfThenElse(is_finite(d, x), far, x), d, ranges + i);
  });
}

/// floor(x / quantum + 1/2) * quantum in double precision. Adding and subtracting 1.5 * 2^52 rounds
/// to an integer below 2^51; larger numbers in single precision have no fraction.
void round(float* ranges, std::size_t count, double quantum) {
  for_all<double>(count, [&](auto d, std::size_t i) HWY_ATTR {
    const hn::Rebind<float, decltype(d)> singles;
    const auto range = hn::LoadU(singles, ranges + i);
    const auto x = hn::PromoteTo(d, range);
    const auto bounded = hn::IfThenZeroElse(hn::Lt(x, hn::Zero(d)), x);
    const auto steps = hn::Add(hn::Div(bounded, hn::Set(d, quantum)), hn::Set(d, 0.5));
    const auto rounder = hn::Set(d, 0x1.8p52);
    const auto near = hn::Sub(hn::Add(steps, rounder), rounder);
    const auto floor = hn::IfThenElse(hn::Gt(near, steps), hn::Sub(near, hn::Set(d, 1.0)), near);
    const auto whole = hn::IfThenElse(hn::Lt(steps, hn::Set(d, 0x1p51)), floor, steps);
    const auto rounded = hn::Min(hn::Mul(whole, hn::Set(d, quantum)), hn::Set(d, double{kLargest}));
    hn::StoreU(hn::IfThenElse(is_finite(singles, range), hn::DemoteTo(singles, rounded), range),
               singles, ranges + i);
  });
}

void silence(float* ranges, std::size_t count, const std::uint32_t* words, std::uint32_t limit) {
  for_all<float>(count, [&](auto d, std::size_t i) HWY_ATTR {
    const hn::RebindToUnsigned<decltype(d)> bits;
    const auto kept = hn::Gt(hn::LoadU(bits, words + i), hn::Set(bits, limit));
    const auto no_return = hn::Set(d, std::numeric_limits<float>::infinity());
    hn::StoreU(hn::IfThenElse(hn::RebindMask(d, kept), hn::LoadU(d, ranges + i), no_return), d,
               ranges + i);
  });
}

/// If the new reading is larger, the values between the old and the new one move down by one rank,
/// otherwise up. Goes from the lowest rank to the highest; `below` keeps the value one rank below.
void exchange_all(std::int32_t* sorted, std::size_t stride, std::size_t window, std::size_t count,
                  const Exchange& exchange) {
  for (std::size_t k = 0; k < window; ++k) {
    std::int32_t* const here = sorted + stride * k;
    for_all<std::int32_t>(count, [&](auto d, std::size_t i) HWY_ATTR {
      const auto s = hn::LoadU(d, here + i);
      const auto old = hn::LoadU(d, exchange.old + i);
      const auto fresh = hn::LoadU(d, exchange.fresh + i);
      const auto below = k > 0 ? hn::LoadU(d, exchange.below + i)
                               : hn::Set(d, std::numeric_limits<std::int32_t>::min());
      const auto above = k + 1 < window ? hn::LoadU(d, here + stride + i)
                                        : hn::Set(d, std::numeric_limits<std::int32_t>::max());
      // Without branches: of the present value, its neighbour and the new reading, the one that has
      // this rank afterwards.
      const auto from_above = hn::Max(s, hn::Min(fresh, above));
      const auto from_below = hn::Min(s, hn::Max(fresh, below));
      const auto larger = hn::IfThenElse(hn::Lt(s, old), s, from_above);
      const auto smaller = hn::IfThenElse(hn::Gt(s, old), s, from_below);
      hn::StoreU(hn::IfThenElse(hn::Lt(fresh, old), smaller, larger), d, here + i);
      hn::StoreU(s, d, exchange.below + i);
    });
  }
}

void blend(float* ranges, std::size_t count, double gain, double* outputs) {
  for_all<double>(count, [&](auto d, std::size_t i) HWY_ATTR {
    const hn::Rebind<float, decltype(d)> singles;
    const auto range = hn::LoadU(singles, ranges + i);
    const auto x = hn::PromoteTo(d, range);
    const auto before = hn::LoadU(d, outputs + i);
    const auto moved = hn::Add(before, hn::Mul(hn::Set(d, gain), hn::Sub(x, before)));
    // NaN is not equal to itself: there is no earlier output, and this one starts the mean.
    const auto now = hn::IfThenElse(hn::Eq(before, before), moved, x);
    const auto finite = hn::Le(hn::Abs(x), hn::Set(d, double{kLargest}));
    const auto none = hn::Set(d, std::numeric_limits<double>::quiet_NaN());
    hn::StoreU(hn::IfThenElse(finite, now, none), d, outputs + i);
    hn::StoreU(hn::IfThenElse(is_finite(singles, range), hn::DemoteTo(singles, now), range),
               singles, ranges + i);
  });
}

}  // namespace rave::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rave::detail {

HWY_EXPORT(limit);
HWY_EXPORT(scatter);
HWY_EXPORT(round);
HWY_EXPORT(silence);
HWY_EXPORT(exchange_all);
HWY_EXPORT(blend);

void scatter_ranges(float* ranges, std::size_t count, float sigma, const float* normals) noexcept {
  HWY_DYNAMIC_DISPATCH(scatter)(ranges, count, sigma, normals);
}

void limit_ranges(float* ranges, std::size_t count, float min, float max) noexcept {
  HWY_DYNAMIC_DISPATCH(limit)(ranges, count, min, max);
}

void round_ranges(float* ranges, std::size_t count, double quantum) noexcept {
  HWY_DYNAMIC_DISPATCH(round)(ranges, count, quantum);
}

void silence_ranges(float* ranges, std::size_t count, const std::uint32_t* words,
                    std::uint32_t limit) noexcept {
  HWY_DYNAMIC_DISPATCH(silence)(ranges, count, words, limit);
}

void exchange_in_order(std::int32_t* sorted, std::size_t stride, std::size_t window,
                       std::size_t count, const Exchange& exchange) noexcept {
  HWY_DYNAMIC_DISPATCH(exchange_all)(sorted, stride, window, count, exchange);
}

void blend_ranges(float* ranges, std::size_t count, double gain, double* outputs) noexcept {
  HWY_DYNAMIC_DISPATCH(blend)(ranges, count, gain, outputs);
}

}  // namespace rave::detail
#endif
