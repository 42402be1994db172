// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

/// The loops over rays of noise and filters, with vector instructions. Bit-identical for all
/// instruction sets; nothing is fused or approximated. NaN and infinities are unchanged unless
/// stated. Ranges in metres.
namespace rave::detail {

/// Adds sigma times a normal number; negative results become 0.
void scatter_ranges(float* ranges, std::size_t count, float sigma, const float* normals) noexcept;

/// Rounds to the nearest multiple, halves upwards; negative results become 0.
void round_ranges(float* ranges, std::size_t count, double quantum) noexcept;

/// Finite ranges above `max` become +infinity, those below `min` become `min`.
void limit_ranges(float* ranges, std::size_t count, float min, float max) noexcept;

/// Sets +infinity where the word is at most `limit`.
void silence_ranges(float* ranges, std::size_t count, const std::uint32_t* words,
                    std::uint32_t limit) noexcept;

/// Replaces one reading of a sorted window by another, for each of `count` rays: those of rank k
/// are at `sorted + stride * k`. `below` is scratch memory of `count`.
struct Exchange {
  const std::int32_t* old = nullptr;
  const std::int32_t* fresh = nullptr;
  std::int32_t* below = nullptr;
};
void exchange_in_order(std::int32_t* sorted, std::size_t stride, std::size_t window,
                       std::size_t count, const Exchange& exchange) noexcept;

/// outputs += gain (range - output); without a previous output (NaN) the output is the range.
/// Ranges become the outputs. A non-finite range is passed on and clears the output.
void blend_ranges(float* ranges, std::size_t count, double gain, double* outputs) noexcept;

}  // namespace rave::detail
