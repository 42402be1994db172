// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace rave {

/// What a hashed value was: the channel argument of a RunHash.
enum class HashChannel : std::uint32_t {
  kPercept = 1,
  kCommand = 2,
  kRadio = 3,
  kPose = 4,
  kEvent = 5,
  kInput = 6,  ///< What somebody asked of a run.
};

/// A strong 64-bit mixing step (the finaliser of MurmurHash3, variant 13 by D. Stafford).
[[nodiscard]] constexpr std::uint64_t mix64(std::uint64_t x) noexcept {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9ULL;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// The hash of one item of one step: its place (step, robot, channel, device) and its bits.
/// Bytes are read in little-endian groups of eight, the last group padded with zeros, and the
/// length is part of the hash.
class ItemHash {
 public:
  constexpr ItemHash(std::uint64_t step, std::uint32_t robot, HashChannel channel,
                     std::uint32_t device) noexcept
      : state_(mix64(mix64(step + 0x9e3779b97f4a7c15ULL) ^
                     mix64((std::uint64_t{robot} << 32) |
                           (static_cast<std::uint64_t>(channel) << 24) | device))) {}

  constexpr void add(std::uint64_t word) noexcept {
    state_ = mix64(state_ ^ word) + 0x9e3779b97f4a7c15ULL;
  }
  constexpr void add(double value) noexcept { add(std::bit_cast<std::uint64_t>(value)); }

  void add_bytes(std::span<const std::byte> bytes) noexcept {
    add(static_cast<std::uint64_t>(bytes.size()));
    for (std::size_t i = 0; i < bytes.size(); i += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes.data() + i, bytes.size() - i < 8 ? bytes.size() - i : 8);
      add(word);
    }
  }

  [[nodiscard]] constexpr std::uint64_t value() const noexcept { return mix64(state_); }

 private:
  std::uint64_t state_;
};

/// The hash of a run: the sum mod 2^64 of the hashes of its items, so that items may be added in
/// any order, by any thread or process, and partial sums may be added up.
class RunHash {
 public:
  constexpr void add(const ItemHash& item) noexcept { sum_ += item.value(); }
  constexpr void merge(RunHash other) noexcept { sum_ += other.sum_; }
  [[nodiscard]] constexpr std::uint64_t value() const noexcept { return sum_; }

  friend constexpr bool operator==(RunHash, RunHash) noexcept = default;

 private:
  std::uint64_t sum_ = 0;
};

}  // namespace rave
