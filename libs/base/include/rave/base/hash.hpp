// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace rave {

/// The kind of a hashed value: the `channel` argument of an ItemHash.
enum class HashChannel : std::uint32_t {
  kPercept = 1,
  kCommand = 2,
  kRadio = 3,
  kPose = 4,
  kEvent = 5,
  kInput = 6,  ///< A request that changed the run.
  kState = 7,  ///< Commands::state() of a program.
};

/// A strong 64-bit mixing step (the finaliser of MurmurHash3, variant 13 by D. Stafford).
[[nodiscard]] constexpr std::uint64_t mix64(std::uint64_t x) noexcept {
  x ^= x >> 30;
  x *= 0xbf58476d1ce4e5b9ULL;
  x ^= x >> 27;
  x *= 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// XXH3 hash of the bytes and their number (Y. Collet, https://xxhash.com; equal on all processors
/// since version 0.8.0).
[[nodiscard]] std::uint64_t content_hash(std::span<const std::byte> bytes) noexcept;

/// The hash of one item of one step. It depends on the item's place (step, robot, channel, device)
/// and on the added values in their order.
class ItemHash {
 public:
  constexpr ItemHash(std::uint64_t step, std::uint32_t robot, HashChannel channel,
                     std::uint32_t device) noexcept
      : state_(
            mix64(mix64(step + kOdd) ^ ((std::uint64_t{robot} << 32U) |
                                        (static_cast<std::uint64_t>(channel) << 24U) | device))) {}

  constexpr void add(std::uint64_t word) noexcept { state_ = mix64(state_ ^ word) + kOdd; }
  constexpr void add(double value) noexcept { add(std::bit_cast<std::uint64_t>(value)); }
  /// Also hashes the number of bytes.
  void add_bytes(std::span<const std::byte> bytes) noexcept { add(content_hash(bytes)); }

  [[nodiscard]] constexpr std::uint64_t value() const noexcept { return state_; }

 private:
  static constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15ULL;  ///< 2^64 / the golden ratio.
  std::uint64_t state_;
};

/// The hash of a run: the sum modulo 2^64 of the hashes of its items. Addition commutes, so threads
/// and processes may add items in any order and merge partial sums.
class RunHash {
 public:
  constexpr void add(const ItemHash& item) noexcept { sum_ += item.value(); }
  constexpr void merge(RunHash other) noexcept { sum_ += other.sum_; }
  [[nodiscard]] constexpr std::uint64_t value() const noexcept { return sum_; }
  /// The hash with a sum that another process computed.
  [[nodiscard]] static constexpr RunHash of_value(std::uint64_t value) noexcept {
    RunHash hash;
    hash.sum_ = value;
    return hash;
  }

  friend constexpr bool operator==(RunHash, RunHash) noexcept = default;

 private:
  std::uint64_t sum_ = 0;
};

}  // namespace rave
