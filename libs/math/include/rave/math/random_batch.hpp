// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "rave/base/random.hpp"

/// Batches of random numbers by vector instructions. A number depends only on the key, the counter
/// of its block and its place in the block: results are bit-identical with scalar, SSE4, AVX2 and
/// AVX-512 instructions and for any length. All functions are pure; any thread.
namespace rave {

/// The key of a block of random words; it identifies the stream.
using RandomKey = std::array<std::uint32_t, 2>;
/// The position of a block of random words in its stream.
using RandomCounter = std::array<std::uint32_t, 4>;

/// Sets out[4 b + i] to word i of philox4x32(counters[b], key). Precondition: out.size() <= 4
/// counters.size(); further counters are not used.
void fill_bits(const RandomKey& key, std::span<const RandomCounter> counters,
               std::span<std::uint32_t> out) noexcept;

/// Sets out[i] to the i-th result of bits() from the next whole block of `stream` on.
void fill_bits(const RandomStream& stream, std::span<std::uint32_t> out) noexcept;

/// Draws of the standard normal distribution (mean 0, variance 1), independent of one another and
/// at most 6.67 in magnitude, which cuts off less than 3e-11 of all draws.
///
/// With w the words of fill_bits, a pair is
///     u = (floor(w[2j] / 2) + 1/2) / 2^31,   r = sqrt(-2 ln u),
///     x = pi/4 * s / 2^31   with s = w[2j+1] as a signed number,
///     out[2j], out[2j+1] = r cos x, r sin x,
/// where bit 0 of w[2j+1] swaps the two and bit 1 turns the sign of the cosine; together they reach
/// the whole circle. In single precision: r and both directions have errors below 3e-7 and u is
/// rounded to 24 bits, so draws nearer to 0 than 1e-3 come in steps of up to 3.5e-4.
/// Source: Box and Muller, "A note on the generation of random normal deviates", 1958.
void fill_normal(const RandomKey& key, std::span<const RandomCounter> counters,
                 std::span<float> out) noexcept;

/// Like fill_normal() above, with the words from the next whole block of `stream` on.
void fill_normal(const RandomStream& stream, std::span<float> out) noexcept;

}  // namespace rave
