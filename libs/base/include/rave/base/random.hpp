// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace rave {

/// One block of the Philox 4x32 generator with ten rounds: 128 random bits that are a pure
/// function of key and counter.
/// Source: Salmon, Moraes, Dror, Shaw: "Parallel random numbers: as easy as 1, 2, 3", SC 2011.
[[nodiscard]] constexpr std::array<std::uint32_t, 4> philox4x32(
    std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) noexcept {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t product0 = std::uint64_t{0xD2511F53U} * counter[0];
    const std::uint64_t product1 = std::uint64_t{0xCD9E8D57U} * counter[2];
    counter = {static_cast<std::uint32_t>(product1 >> 32) ^ counter[1] ^ key[0],
               static_cast<std::uint32_t>(product1),
               static_cast<std::uint32_t>(product0 >> 32) ^ counter[3] ^ key[1],
               static_cast<std::uint32_t>(product0)};
    key = {key[0] + 0x9E3779B9U, key[1] + 0xBB67AE85U};
  }
  return counter;
}

/// The random numbers of one sample of one device. They depend on (seed, robot, device, sample,
/// draw) only, so threads, order and the split into processes do not matter. A value that is cheap
/// to construct; use it from one thread.
class RandomStream {
 public:
  constexpr RandomStream(std::uint64_t seed, std::uint32_t robot, std::uint32_t device,
                         std::uint32_t sample) noexcept
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
        counter_{0, sample, device, robot} {}

  /// 32 uniformly distributed bits.
  constexpr std::uint32_t bits() noexcept {
    if (next_ == 4) {
      block_ = philox4x32(counter_, key_);
      ++counter_[0];
      next_ = 0;
    }
    return block_[static_cast<std::size_t>(next_++)];
  }

  /// Uniform in [0, 1), 53 random bits.
  constexpr double uniform() noexcept {
    const std::uint64_t high = bits() >> 5;
    const std::uint64_t low = bits() >> 6;
    return static_cast<double>((high << 26) | low) * 0x1p-53;
  }

  /// Uniform in [low, high).
  constexpr double uniform(double low, double high) noexcept {
    return low + (high - low) * uniform();
  }

  /// The stream positioned at block `block`, that is after 4 * block calls of bits(). The 2^32
  /// blocks repeat cyclically.
  [[nodiscard]] constexpr RandomStream at_block(std::uint32_t block) const noexcept {
    RandomStream moved = *this;
    moved.counter_[0] = block;
    moved.next_ = 4;
    return moved;
  }

  /// Key and counter of the next whole block, for code that computes many blocks at once.
  [[nodiscard]] constexpr const std::array<std::uint32_t, 2>& key() const noexcept { return key_; }
  [[nodiscard]] constexpr const std::array<std::uint32_t, 4>& counter() const noexcept {
    return counter_;
  }

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int next_ = 4;
};

}  // namespace rave
