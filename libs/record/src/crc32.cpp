// SPDX-License-Identifier: Apache-2.0
#include "crc32.hpp"

#include <array>
#include <bit>
#include <cstring>

namespace rave::record {
namespace {

static_assert(std::endian::native == std::endian::little, "words are read as little-endian");

constexpr std::uint32_t kPolynomial = 0xEDB88320U;  // bits reversed
constexpr std::size_t kSlices = 16;
using Tables = std::array<std::array<std::uint32_t, 256>, kSlices>;

// Slicing by several bytes: M. Kounavis and F. Berry, "A systematic approach to building high
// performance software-based CRC generators", 2005. Table s has the CRC of a byte followed by s
// zero bytes.
constexpr Tables make_tables() {
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t sum = byte;
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ ((sum & 1U) != 0 ? kPolynomial : 0U);
    tables[0][byte] = sum;
  }
  for (std::size_t slice = 1; slice < kSlices; ++slice) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t sum = tables[slice - 1][byte];
      tables[slice][byte] = (sum >> 8) ^ tables[0][sum & 0xFFU];
    }
  }
  return tables;
}

constexpr Tables kTables = make_tables();

}  // namespace

std::uint32_t crc32(std::span<const std::byte> bytes, std::uint32_t before) noexcept {
  std::uint32_t sum = ~before;
  const std::byte* at = bytes.data();
  std::size_t rest = bytes.size();
  for (; rest >= kSlices; rest -= kSlices, at += kSlices) {
    std::array<std::uint32_t, kSlices / 4> words{};
    std::memcpy(words.data(), at, kSlices);
    words[0] ^= sum;
    sum = 0;
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::size_t slice = kSlices - 1 - 4 * i;
      sum ^= kTables[slice][words[i] & 0xFFU] ^ kTables[slice - 1][(words[i] >> 8) & 0xFFU] ^
             kTables[slice - 2][(words[i] >> 16) & 0xFFU] ^ kTables[slice - 3][words[i] >> 24];
    }
  }
  for (; rest > 0; --rest, ++at) {
    sum = (sum >> 8) ^ kTables[0][(sum ^ std::to_integer<std::uint32_t>(*at)) & 0xFFU];
  }
  return ~sum;
}

}  // namespace rave::record
