// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// The loops over rays of noise and filters, in vector instructions. Equal bits with all of them;
/// nothing is fused or approximated. What is no number or infinite stays as it is where a function
/// does not say otherwise. Ranges in metres.
namespace rave::detail {

/// Adds sigma times a normal number; below zero becomes 0.
void scatter_ranges(float* ranges, std::size_t count, float sigma, const float* normals) noexcept;

/// Rounds to the nearest multiple, halves upwards; below zero becomes 0.
void round_ranges(float* ranges, std::size_t count, double quantum) noexcept;

/// What is finite and above `max` becomes +infinity, what is finite and below `min` becomes `min`.
void limit_ranges(float* ranges, std::size_t count, float min, float max) noexcept;

/// +infinity where a word is at most `limit`.
void silence_ranges(float* ranges, std::size_t count, const std::uint32_t* words,
                    std::uint32_t limit) noexcept;

/// Where a sorted window loses one reading and gets another, for each of `count` rays: those of
/// rank k stand in `sorted + stride * k`. `below` is scratch of `count`.
struct Exchange {
  const std::int32_t* old = nullptr;
  const std::int32_t* fresh = nullptr;
  std::int32_t* below = nullptr;
};
void exchange_in_order(std::int32_t* sorted, std::size_t stride, std::size_t window,
                       std::size_t count, const Exchange& exchange) noexcept;

/// outputs += gain (range - output), where NaN is no output yet: then the range. Ranges become the
/// outputs. A range that is not finite passes, and there is no output after it.
void blend_ranges(float* ranges, std::size_t count, double gain, double* outputs) noexcept;

}  // namespace rave::detail
