// SPDX-License-Identifier: Apache-2.0
#include "rave/base/random.hpp"

#include <gtest/gtest.h>

namespace rave {
namespace {

// Known answers published with the reference implementation (Random123, file kat_vectors).
TEST(Philox, GivesThePublishedAnswers) {
  using Block = std::array<std::uint32_t, 4>;
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}),
            (Block{0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U}));
  EXPECT_EQ(philox4x32({~0U, ~0U, ~0U, ~0U}, {~0U, ~0U}),
            (Block{0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU}));
  EXPECT_EQ(
      philox4x32({0x243f6a88U, 0x85a308d3U, 0x13198a2eU, 0x03707344U}, {0xa4093822U, 0x299f31d0U}),
      (Block{0xd16cfe09U, 0x94fdccebU, 0x5001e420U, 0x24126ea1U}));
}

TEST(RandomStream, IsAFunctionOfItsPlaceAlone) {
  RandomStream once(1, 2, 3, 4);
  RandomStream again(1, 2, 3, 4);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(once.bits(), again.bits());
}

TEST(RandomStream, EveryCoordinateMatters) {
  const std::uint32_t first = RandomStream(1, 2, 3, 4).bits();
  EXPECT_NE(first, RandomStream(9, 2, 3, 4).bits());
  EXPECT_NE(first, RandomStream(1, 9, 3, 4).bits());
  EXPECT_NE(first, RandomStream(1, 2, 9, 4).bits());
  EXPECT_NE(first, RandomStream(1, 2, 3, 9).bits());
  EXPECT_NE(first, RandomStream(1ULL << 32 | 1, 2, 3, 4).bits());
}

TEST(RandomStream, UniformHasItsMeanAndVariance) {
  double sum = 0;
  double squares = 0;
  constexpr int kCount = 100'000;
  for (std::uint32_t sample = 0; sample < kCount; ++sample) {
    const double u = RandomStream(5, 1, 1, sample).uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    squares += u * u;
  }
  const double mean = sum / kCount;
  // Five standard errors: 1/sqrt(12 n) for the mean, sqrt(1/180 n) for the variance.
  EXPECT_NEAR(mean, 0.5, 5 * 0.2887 / 316.2);
  EXPECT_NEAR(squares / kCount - mean * mean, 1.0 / 12, 5 * 0.0745 / 316.2);
}

}  // namespace
}  // namespace rave
