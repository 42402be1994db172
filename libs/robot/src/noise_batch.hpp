// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "rave/math/random_batch.hpp"
#include "rave/robot/processing.hpp"

namespace rave::detail {

/// Records `first` to `first + count - 1` of one sample.
struct NoisePiece {
  const NoiseItem* item;
  std::uint32_t first;
  std::uint32_t count;
  std::uint32_t place;  ///< Index of their first number in the batch.

  template <class Record>
  [[nodiscard]] Record* records() const noexcept {
    return static_cast<Record*>(item->records) + first;
  }
};

/// Draws the random numbers for the records of many samples together, so that short samples fill
/// vectors too. It collects counters until a batch is full, draws the batch and calls `use(piece,
/// numbers)` for each piece, in the order of the records. Number i of a sample is number i of its
/// stream from block `first_block` on; a record takes `kPerRecord` of them. `Number`: float for
/// normal numbers, std::uint32_t for bits. Lives on the stack; the destructor serves the rest.
template <class Number, std::uint32_t kPerRecord, class Use>
class NoiseBatch {
 public:
  NoiseBatch(std::uint32_t first_block, Use use) noexcept : first_block_(first_block), use_(use) {}
  NoiseBatch(const NoiseBatch&) = delete;
  NoiseBatch& operator=(const NoiseBatch&) = delete;
  ~NoiseBatch() { flush(); }

  /// Requests numbers for the first `count` records of a sample.
  void add(const NoiseItem& item, std::uint32_t count) noexcept {
    const RandomKey& key = item.random.key();
    if (key[0] != key_[0] || key[1] != key_[1]) {
      flush();
      key_ = key;
    }
    for (std::uint32_t first = 0; first < count;) {
      const std::uint32_t room = (kBlocks - blocks_) * 4 / kPerRecord;
      std::uint32_t fitting = count - first;
      // The next piece must begin with a block.
      if (fitting > room) fitting = room / 4 * 4;
      if (fitting == 0) {
        flush();
        continue;
      }
      take(item, first, fitting);
      first += fitting;
    }
  }

 private:
  static constexpr std::uint32_t kBlocks = 128;

  void take(const NoiseItem& item, std::uint32_t first, std::uint32_t count) noexcept {
    pieces_[pieces_used_++] = {&item, first, count, 4 * blocks_};
    RandomCounter counter = item.random.counter();
    counter[0] += first_block_ + first / 4 * kPerRecord;
    const std::uint32_t end = blocks_ + (count * kPerRecord + 3) / 4;
    for (; blocks_ < end; ++blocks_, ++counter[0]) counters_[blocks_] = counter;
  }

  void draw(std::span<float> numbers) noexcept {
    fill_normal(key_, {counters_.data(), blocks_}, numbers);
  }
  void draw(std::span<std::uint32_t> numbers) noexcept {
    fill_bits(key_, {counters_.data(), blocks_}, numbers);
  }

  void flush() noexcept {
    if (blocks_ == 0) return;
    std::array<Number, std::size_t{4} * kBlocks> numbers;
    draw({numbers.data(), std::size_t{4} * blocks_});
    for (const NoisePiece& piece : std::span(pieces_).first(pieces_used_)) {
      use_(piece, numbers.data() + piece.place);
    }
    blocks_ = 0;
    pieces_used_ = 0;
  }

  std::uint32_t first_block_;
  Use use_;
  RandomKey key_{};
  std::uint32_t blocks_ = 0;
  std::uint32_t pieces_used_ = 0;
  // Deliberately uninitialised: they are written before they are read, and clearing would cost more
  // than drawing a few numbers.
  std::array<RandomCounter, kBlocks> counters_;
  std::array<NoisePiece, kBlocks> pieces_;
};

}  // namespace rave::detail
