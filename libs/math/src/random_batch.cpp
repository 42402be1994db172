// SPDX-License-Identifier: Apache-2.0
#include "rave/math/random_batch.hpp"

#include <cstddef>
#include <cstring>

#include "rave/base/check.hpp"

// Highway compiles this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/random_batch.cpp"
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace rave::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::CappedTag<float, 16>;
using Words = hn::RebindToUnsigned<Floats>;
using Integers = hn::RebindToSigned<Floats>;
using Products = hn::Repartition<std::uint64_t, Words>;
using FloatVector = hn::Vec<Floats>;
using WordVector = hn::Vec<Words>;
using ProductVector = hn::Vec<Products>;

constexpr std::size_t kRounds = 10;
/// Blocks per vector (one per lane), and numbers per group of these blocks.
constexpr std::size_t kBlocks = hn::MaxLanes(Floats());
constexpr std::size_t kGroup = 4 * kBlocks;

/// The four words of each block, one vector per word.
struct Blocks {
  WordVector word[4];
};

/// Every other block. A word is in the lower half of 64 bits, because a product needs twice its
/// width. The upper half is ignored by the multiplication.
struct HalfBlocks {
  ProductVector word[4];
};

/// The keys of all rounds of philox4x32().
struct RoundKeys {
  ProductVector first[kRounds];
  ProductVector second[kRounds];

  HWY_INLINE explicit RoundKeys(const RandomKey& key) {
    const Products d;
    RandomKey of_round = key;
    for (std::size_t round = 0; round < kRounds; ++round) {
      first[round] = hn::Set(d, std::uint64_t{of_round[0]});
      second[round] = hn::Set(d, std::uint64_t{of_round[1]});
      of_round = {of_round[0] + 0x9E3779B9U, of_round[1] + 0xBB67AE85U};
    }
  }
};

HWY_INLINE ProductVector times(ProductVector a, std::uint32_t b) {
  const Words words;
  return hn::MulEven(hn::BitCast(words, a), hn::Set(words, b));
}

HWY_INLINE void mix_once(HalfBlocks& half, ProductVector key0, ProductVector key1) {
  const auto product0 = times(half.word[0], 0xD2511F53U);
  const auto product1 = times(half.word[2], 0xCD9E8D57U);
  half.word[0] = hn::Xor3(hn::ShiftRight<32>(product1), half.word[1], key0);
  half.word[1] = product1;
  half.word[2] = hn::Xor3(hn::ShiftRight<32>(product0), half.word[3], key1);
  half.word[3] = product0;
}

/// philox4x32() of rave/base/random.hpp, for each lane.
HWY_INLINE Blocks mixed(const Blocks& counter, const RoundKeys& keys) {
  const Products d;
  const Words words;
  HalfBlocks even;
  HalfBlocks odd;
  for (std::size_t i = 0; i < 4; ++i) {
#if HWY_TARGET == HWY_SCALAR
    even.word[i] = hn::Set(d, std::uint64_t{hn::GetLane(counter.word[i])});
    odd.word[i] = even.word[i];
#else
    even.word[i] = hn::BitCast(d, counter.word[i]);
    odd.word[i] = hn::ShiftRight<32>(even.word[i]);
#endif
  }
  for (std::size_t round = 0; round < kRounds; ++round) {
    mix_once(even, keys.first[round], keys.second[round]);
    mix_once(odd, keys.first[round], keys.second[round]);
  }
  Blocks all;
  for (std::size_t i = 0; i < 4; ++i) {
    all.word[i] = hn::OddEven(hn::BitCast(words, hn::ShiftLeft<32>(odd.word[i])),
                              hn::BitCast(words, even.word[i]));
  }
  return all;
}

/// Counters in memory; the last group may have fewer than a vector holds.
class GivenCounters {
 public:
  explicit GivenCounters(const RandomCounter* counters) : counters_(counters) {}

  HWY_INLINE Blocks group(std::size_t block, std::size_t left) const {
    Blocks counter;
    const std::uint32_t* from = counters_[block].data();
    HWY_ALIGN std::uint32_t last[kGroup];
    if (left < kBlocks) {
      for (std::size_t i = 0; i < kGroup; ++i) last[i] = i < 4 * left ? from[i] : 0;
      from = last;
    }
    hn::LoadInterleaved4(Words(), from, counter.word[0], counter.word[1], counter.word[2],
                         counter.word[3]);
    return counter;
  }

 private:
  const RandomCounter* counters_;
};

/// Consecutive counters of one stream; 0 follows 2^32 - 1.
class CountersInTurn {
 public:
  explicit CountersInTurn(const RandomCounter& first) : first_(first) {}

  HWY_INLINE Blocks group(std::size_t block, std::size_t /*left*/) const {
    const Words d;
    Blocks counter;
    counter.word[0] = hn::Iota(d, first_[0] + static_cast<std::uint32_t>(block));
    for (std::size_t i = 1; i < 4; ++i) counter.word[i] = hn::Set(d, first_[i]);
    return counter;
  }

 private:
  RandomCounter first_;
};

/// -2 ln u for u in [2^-32, 1]. With u = 2^k m, m from sqrt(1/2) to sqrt(2), and
/// s = (m - 1) / (m + 1):
///     ln u = k ln 2 + 2 s + s^3 P(s^2)
/// P is a minimax polynomial by the algorithm of Remez; relative error of ln m 1.6e-9.
HWY_INLINE FloatVector minus_twice_log(FloatVector u) {
  const Floats d;
  const Integers integers;
  const auto bits = hn::BitCast(integers, u);
  const auto above = hn::Sub(bits, hn::Set(integers, 0x3F3504F3));  // bits of sqrt(1/2)
  const auto exponent = hn::ShiftRight<23>(above);
  const auto m = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(exponent)));
  const auto one = hn::Set(d, 1.0F);
  const auto s = hn::Div(hn::Sub(m, one), hn::Add(m, one));
  const auto z = hn::Mul(s, s);
  auto p = hn::Set(d, 0x1.31e2f2p-2F);
  p = hn::Add(hn::Mul(p, z), hn::Set(d, 0x1.995ebap-2F));
  p = hn::Add(hn::Mul(p, z), hn::Set(d, 0x1.55557ap-1F));
  const auto log_m = hn::Add(hn::Add(s, s), hn::Mul(hn::Mul(p, z), s));
  const auto log_power = hn::Mul(hn::ConvertTo(d, exponent), hn::Set(d, 0x1.62e43p-1F));
  return hn::Mul(hn::Set(d, -2.0F), hn::Add(log_power, log_m));
}

/// Cosine and sine on [-pi/4, pi/4]; minimax polynomials as above, errors 1e-10 and 2e-9.
HWY_INLINE FloatVector small_cos(FloatVector z) {
  const Floats d;
  auto p = hn::Set(d, 0x1.9a025ap-16F);
  p = hn::Add(hn::Mul(p, z), hn::Set(d, -0x1.6c0c8cp-10F));
  p = hn::Add(hn::Mul(p, z), hn::Set(d, 0x1.55554ap-5F));
  const auto half = hn::Sub(hn::Set(d, 0.5F), hn::Mul(p, z));
  return hn::Sub(hn::Set(d, 1.0F), hn::Mul(half, z));
}
HWY_INLINE FloatVector small_sin(FloatVector x, FloatVector z) {
  const Floats d;
  auto p = hn::Set(d, -0x1.98da66p-13F);
  p = hn::Add(hn::Mul(p, z), hn::Set(d, 0x1.1105b4p-7F));
  p = hn::Add(hn::Mul(p, z), hn::Set(d, -0x1.55554p-3F));
  return hn::Add(x, hn::Mul(hn::Mul(p, z), x));
}

HWY_INLINE void box_muller(WordVector radius, WordVector turn, FloatVector& first,
                           FloatVector& second) {
  const Floats d;
  const Words words;
  const Integers integers;
  const auto steps = hn::ConvertTo(d, hn::BitCast(integers, hn::ShiftRight<1>(radius)));
  const auto u = hn::Mul(hn::Add(steps, hn::Set(d, 0.5F)), hn::Set(d, 0x1p-31F));
  const auto r = hn::Sqrt(minus_twice_log(u));
  const auto x =
      hn::Mul(hn::ConvertTo(d, hn::BitCast(integers, turn)), hn::Set(d, 0x1.921fb6p-32F));
  const auto z = hn::Mul(x, x);
  const auto sign = hn::And(hn::ShiftLeft<30>(turn), hn::Set(words, 0x80000000U));
  const auto ahead = hn::Xor(hn::Mul(r, small_cos(z)), hn::BitCast(d, sign));
  const auto aside = hn::Mul(r, small_sin(x, z));
  const auto swapped = hn::RebindMask(d, hn::TestBit(turn, hn::Set(words, 1U)));
  first = hn::IfThenElse(swapped, aside, ahead);
  second = hn::IfThenElse(swapped, ahead, aside);
}

struct AsBits {
  using Value = std::uint32_t;

  static HWY_INLINE void store(const Blocks& mixed, Value* out) {
    hn::StoreInterleaved4(mixed.word[0], mixed.word[1], mixed.word[2], mixed.word[3], Words(), out);
  }
};

struct AsNormals {
  using Value = float;

  static HWY_INLINE void store(const Blocks& mixed, Value* out) {
    FloatVector value[4];
    box_muller(mixed.word[0], mixed.word[1], value[0], value[1]);
    box_muller(mixed.word[2], mixed.word[3], value[2], value[3]);
    hn::StoreInterleaved4(value[0], value[1], value[2], value[3], Floats(), out);
  }
};

/// An incomplete group goes through a buffer.
template <class As, class Counters>
HWY_INLINE void fill(const RandomKey& key, const Counters& counters, typename As::Value* out,
                     std::size_t count) {
  const RoundKeys keys(key);
  std::size_t block = 0;
  for (; count >= kGroup; count -= kGroup, out += kGroup, block += kBlocks) {
    As::store(mixed(counters.group(block, kBlocks), keys), out);
  }
  if (count == 0) return;
  HWY_ALIGN typename As::Value last[kGroup];
  As::store(mixed(counters.group(block, (count + 3) / 4), keys), last);
  std::memcpy(out, last, count * sizeof(*out));
}

void bits_of_counters(const RandomKey& key, const RandomCounter* counters, std::uint32_t* out,
                      std::size_t count) {
  fill<AsBits>(key, GivenCounters(counters), out, count);
}
void bits_in_turn(const RandomKey& key, const RandomCounter& first, std::uint32_t* out,
                  std::size_t count) {
  fill<AsBits>(key, CountersInTurn(first), out, count);
}
void normals_of_counters(const RandomKey& key, const RandomCounter* counters, float* out,
                         std::size_t count) {
  fill<AsNormals>(key, GivenCounters(counters), out, count);
}
void normals_in_turn(const RandomKey& key, const RandomCounter& first, float* out,
                     std::size_t count) {
  fill<AsNormals>(key, CountersInTurn(first), out, count);
}

}  // namespace rave::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace rave {

HWY_EXPORT(bits_of_counters);
HWY_EXPORT(bits_in_turn);
HWY_EXPORT(normals_of_counters);
HWY_EXPORT(normals_in_turn);

void fill_bits(const RandomKey& key, std::span<const RandomCounter> counters,
               std::span<std::uint32_t> out) noexcept {
  RAVE_CHECK(out.size() <= 4 * counters.size());
  HWY_DYNAMIC_DISPATCH(bits_of_counters)(key, counters.data(), out.data(), out.size());
}

void fill_bits(const RandomStream& stream, std::span<std::uint32_t> out) noexcept {
  HWY_DYNAMIC_DISPATCH(bits_in_turn)(stream.key(), stream.counter(), out.data(), out.size());
}

void fill_normal(const RandomKey& key, std::span<const RandomCounter> counters,
                 std::span<float> out) noexcept {
  RAVE_CHECK(out.size() <= 4 * counters.size());
  HWY_DYNAMIC_DISPATCH(normals_of_counters)(key, counters.data(), out.data(), out.size());
}

void fill_normal(const RandomStream& stream, std::span<float> out) noexcept {
  HWY_DYNAMIC_DISPATCH(normals_in_turn)(stream.key(), stream.counter(), out.data(), out.size());
}

}  // namespace rave
#endif
