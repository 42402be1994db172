// SPDX-License-Identifier: Apache-2.0
#include "rave/math/random_batch.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "rave/math_testing/each_target.hpp"

namespace rave {
namespace {

constexpr std::uint32_t kAll = 0xffffffffU;
constexpr float kUntouched = -77;

/// The same numbers as fill_normal(), word by word: written a second time, without vectors.
struct Pair {
  float first = 0;
  float second = 0;
  float u = 0;
};

Pair normal_pair(std::uint32_t radius, std::uint32_t turn) {
  const float u = (static_cast<float>(radius >> 1) + 0.5F) * 0x1p-31F;
  int exponent = 0;
  float m = std::frexp(u, &exponent);
  if (std::bit_cast<std::uint32_t>(m) < 0x3F3504F3U) {  // sqrt(1/2)
    m = m + m;
    --exponent;
  }
  const float s = (m - 1) / (m + 1);
  const float s2 = s * s;
  const float p = (0x1.31e2f2p-2F * s2 + 0x1.995ebap-2F) * s2 + 0x1.55557ap-1F;
  const float log_m = (s + s) + p * s2 * s;
  const float log_u = static_cast<float>(exponent) * 0x1.62e43p-1F + log_m;
  const float r = std::sqrt(-2 * log_u);
  const float x = static_cast<float>(static_cast<std::int32_t>(turn)) * 0x1.921fb6p-32F;
  const float z = x * x;
  const float sine = x + ((-0x1.98da66p-13F * z + 0x1.1105b4p-7F) * z + -0x1.55554p-3F) * z * x;
  const float part = (0x1.9a025ap-16F * z + -0x1.6c0c8cp-10F) * z + 0x1.55554ap-5F;
  const float cosine = 1 - (0.5F - part * z) * z;
  const float ahead = (turn & 2U) != 0 ? -(r * cosine) : r * cosine;
  const float aside = r * sine;
  return (turn & 1U) != 0 ? Pair{aside, ahead, u} : Pair{ahead, aside, u};
}

RandomStream stream() { return {0x0123456789abcdefULL, 7, 0x80000003U, 41}; }

std::vector<RandomCounter> counters_of(const RandomStream& from, std::size_t count) {
  std::vector<RandomCounter> counters(count, from.counter());
  for (std::size_t b = 0; b < count; ++b) counters[b][0] += static_cast<std::uint32_t>(b);
  return counters;
}

// Known answers published with the reference implementation (Random123, file kat_vectors).
TEST(FillBits, GivesThePublishedAnswersInEveryLane) {
  struct Known {
    RandomCounter counter;
    RandomKey key;
    RandomCounter answer;
  };
  const Known known[] = {
      {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U}},
      {{kAll, kAll, kAll, kAll},
       {kAll, kAll},
       {0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU}},
      {{0x243f6a88U, 0x85a308d3U, 0x13198a2eU, 0x03707344U},
       {0xa4093822U, 0x299f31d0U},
       {0xd16cfe09U, 0x94fdccebU, 0x5001e420U, 0x24126ea1U}},
  };
  const int targets = for_each_target([&](const char* name) {
    for (const Known& k : known) {
      const std::vector<RandomCounter> counters(19, k.counter);
      std::vector<std::uint32_t> words(4 * counters.size());
      fill_bits(k.key, counters, words);
      for (std::size_t i = 0; i < words.size(); ++i) {
        ASSERT_EQ(words[i], k.answer[i % 4]) << name << ", word " << i;
      }
    }
  });
  EXPECT_GE(targets, 2) << "a processor with one set of instructions shows nothing";
}

TEST(FillBits, IsTheStreamForAllLengths) {
  RandomStream drawn = stream();
  std::vector<std::uint32_t> expected(1001);
  for (std::uint32_t& word : expected) word = drawn.bits();
  const auto counters = counters_of(stream(), 250);
  for_each_target([&](const char* name) {
    for (std::size_t n = 0; n <= 1000; ++n) {
      std::vector<std::uint32_t> in_turn(n + 1, kAll);
      std::vector<std::uint32_t> given(n + 1, kAll);
      fill_bits(stream(), std::span(in_turn).first(n));
      fill_bits(stream().key(), counters, std::span(given).first(n));
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_EQ(in_turn[i], expected[i]) << name << ", word " << i << " of " << n;
        ASSERT_EQ(given[i], expected[i]) << name << ", word " << i << " of " << n;
      }
      ASSERT_EQ(in_turn[n], kAll) << name << " wrote beyond " << n;
      ASSERT_EQ(given[n], kAll) << name << " wrote beyond " << n;
    }
  });
}

TEST(FillBits, StartsWithTheNextWholeBlock) {
  RandomStream begun = stream();
  EXPECT_NE(begun.bits(), begun.bits());
  std::vector<std::uint32_t> words(4);
  fill_bits(begun, words);
  RandomStream second = stream().at_block(1);
  for (const std::uint32_t word : words) EXPECT_EQ(word, second.bits());
  fill_bits(stream().at_block(1), words);
  EXPECT_EQ(words[0], stream().at_block(1).bits());
}

TEST(FillBits, BlocksWrapAround) {
  for_each_target([&](const char* name) {
    std::vector<std::uint32_t> words(4 * 40);
    fill_bits(stream().at_block(kAll - 20), words);
    for (std::uint32_t b = 0; b < 40; ++b) {
      RandomStream block = stream().at_block(kAll - 20 + b);
      ASSERT_EQ(words[4 * std::size_t{b}], block.bits()) << name << ", block " << b;
    }
  });
}

TEST(FillNormal, HasEqualBitsWithAllInstructionsAndLengths) {
  std::vector<std::uint32_t> words(1000);
  fill_bits(stream(), words);
  std::vector<float> expected;
  for (std::size_t i = 0; i < words.size(); i += 2) {
    const Pair pair = normal_pair(words[i], words[i + 1]);
    expected.push_back(pair.first);
    expected.push_back(pair.second);
  }
  const auto counters = counters_of(stream(), 250);
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  for_each_target([&](const char* name) {
    for (std::size_t n = 1; n <= 1000; ++n) {
      std::vector<float> in_turn(n + 1, kUntouched);
      std::vector<float> given(n + 1, kUntouched);
      fill_normal(stream(), std::span(in_turn).first(n));
      fill_normal(stream().key(), counters, std::span(given).first(n));
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_EQ(bits(in_turn[i]), bits(expected[i])) << name << ", draw " << i << " of " << n;
        ASSERT_EQ(bits(given[i]), bits(expected[i])) << name << ", draw " << i << " of " << n;
      }
      ASSERT_EQ(in_turn[n], kUntouched) << name << " wrote beyond " << n;
      ASSERT_EQ(given[n], kUntouched) << name << " wrote beyond " << n;
    }
  });
}

TEST(FillNormal, HasEqualBitsInAMillionDraws) {
  std::vector<std::uint32_t> words(1'000'000);
  fill_bits(stream(), words);
  for_each_target([&](const char* name) {
    std::vector<float> draws(words.size());
    fill_normal(stream(), draws);
    for (std::size_t i = 0; i < words.size(); i += 2) {
      const Pair pair = normal_pair(words[i], words[i + 1]);
      ASSERT_EQ(std::bit_cast<std::uint32_t>(draws[i]), std::bit_cast<std::uint32_t>(pair.first))
          << name << ", draw " << i;
      ASSERT_EQ(std::bit_cast<std::uint32_t>(draws[i + 1]),
                std::bit_cast<std::uint32_t>(pair.second))
          << name << ", draw " << i + 1;
    }
  });
}

/// How far a pair is from the formula of the header in double precision, over 1 + its magnitude.
double error_of(std::uint32_t radius, std::uint32_t turn) {
  const Pair pair = normal_pair(radius, turn);
  const double r = std::sqrt(-2 * std::log(double{pair.u}));
  const double x = std::acos(-1.0) / 4 * static_cast<std::int32_t>(turn) / 0x1p31;
  const double ahead = (turn & 2U) != 0 ? -r * std::cos(x) : r * std::cos(x);
  const double aside = r * std::sin(x);
  const bool swapped = (turn & 1U) != 0;
  const double first = (swapped ? aside : ahead) - double{pair.first};
  const double second = (swapped ? ahead : aside) - double{pair.second};
  return std::max(std::abs(first), std::abs(second)) / (1 + r);
}

TEST(FillNormal, IsCloseToTheFormulaInDoublePrecision) {
  std::vector<std::uint32_t> words(2'000'000);
  fill_bits(stream(), words);
  double worst = 0;
  for (std::size_t i = 0; i < words.size(); i += 2) {
    worst = std::max(worst, error_of(words[i], words[i + 1]));
    const double exact = ((words[i] >> 1) + 0.5) / 0x1p31;
    ASSERT_LE(std::abs(double{normal_pair(words[i], 0).u} - exact), exact * 0x1p-23);
  }
  EXPECT_LT(worst, 3e-7);
  // Around every power of two, both ends of the circle's eighths, and the middle.
  worst = 0;
  for (int shift = 0; shift < 32; ++shift) {
    for (std::uint32_t radius = (1U << shift) - 3; radius != (1U << shift) + 4; ++radius) {
      for (std::uint32_t turn : {0U, 1U, 0x7fffffffU, 0x80000000U, kAll, 0x12345678U}) {
        worst = std::max(worst, error_of(radius, turn));
      }
    }
  }
  EXPECT_LT(worst, 3e-7);
}

TEST(FillNormal, EndsWhereTheHeaderSays) {
  EXPECT_NEAR(normal_pair(0, 0).first, 6.6604, 1e-4);
  EXPECT_NEAR(normal_pair(1, 2).first, -6.6604, 1e-4);
  EXPECT_EQ(normal_pair(kAll, 0).first, 0);
  EXPECT_EQ(normal_pair(kAll, kAll).first, 0);
  EXPECT_NEAR(std::hypot(normal_pair(kAll - 255, 5).first, normal_pair(kAll - 255, 5).second),
              3.45e-4, 1e-6);
}

TEST(FillNormal, EveryPartOfTheCircleIsReached) {
  int eighths[8] = {};
  std::vector<float> draws(80'000);
  fill_normal(stream(), draws);
  for (std::size_t i = 0; i < draws.size(); i += 2) {
    const double turn = std::atan2(draws[i + 1], draws[i]) / (2 * std::acos(-1.0)) + 0.5;
    ++eighths[std::min(7, static_cast<int>(turn * 8))];
  }
  for (const int count : eighths) EXPECT_NEAR(count, 5000, 5 * std::sqrt(5000 * 7.0 / 8));
}

}  // namespace
}  // namespace rave
