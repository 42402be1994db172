// SPDX-License-Identifier: Apache-2.0
#include "create_oi/oi_decoder.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace rave::oi {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The example of the specification: cliff left signal 549, no virtual wall.
const Bytes kExample{19, 5, 29, 2, 37, 13, 0, 151};

Bytes framed(const Bytes& body) {
  Bytes frame{19, static_cast<std::uint8_t>(body.size())};
  for (const std::uint8_t byte : body) frame.push_back(byte);
  const unsigned sum = std::accumulate(frame.begin(), frame.end(), 0U);
  frame.push_back(static_cast<std::uint8_t>(256 - sum % 256));
  return frame;
}

/// Bodies of the frames that come out.
std::vector<Bytes> decode(StreamDecoder& decoder, const Bytes& bytes) {
  std::vector<Bytes> bodies;
  for (const std::uint8_t byte : bytes) {
    if (const Frame* const frame = decoder.push(byte, 0)) {
      bodies.emplace_back(frame->body.begin(), frame->body.end());
    }
  }
  return bodies;
}

Bytes operator+(Bytes a, const Bytes& b) {
  for (const std::uint8_t byte : b) a.push_back(byte);
  return a;
}

TEST(StreamDecoder, TakesAFrame) {
  ASSERT_EQ(framed({29, 2, 37, 13, 0}), kExample);
  StreamDecoder decoder({29, 13});
  EXPECT_EQ(decoder.frame_size(), 8U);
  EXPECT_EQ(decode(decoder, kExample + kExample),
            (std::vector<Bytes>{{29, 2, 37, 13, 0}, {29, 2, 37, 13, 0}}));
  EXPECT_EQ(decoder.counts().frames, 2U);
  EXPECT_EQ(decoder.counts().skipped, 0U);
}

TEST(StreamDecoder, OneLostByteCostsOneFrame) {
  for (std::size_t lost = 0; lost < kExample.size(); ++lost) {
    StreamDecoder decoder({29, 13});
    Bytes torn = kExample;
    torn.erase(torn.begin() + static_cast<std::ptrdiff_t>(lost));
    EXPECT_EQ(decode(decoder, kExample + torn + kExample).size(), 2U) << "byte " << lost;
  }
}

TEST(StreamDecoder, OneGarbledByteCostsOneFrame) {
  for (std::size_t at = 0; at < kExample.size(); ++at) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      StreamDecoder decoder({29, 13});
      Bytes garbled = kExample;
      garbled[at] = static_cast<std::uint8_t>(garbled[at] ^ (1U << bit));
      EXPECT_EQ(decode(decoder, garbled + kExample).size(), 1U) << "byte " << at << " bit " << bit;
    }
  }
}

TEST(StreamDecoder, OneByteTooManyCostsOneFrame) {
  for (std::size_t at = 0; at <= kExample.size(); ++at) {
    for (const std::uint8_t extra : Bytes{0, 5, 19, 255}) {
      StreamDecoder decoder({29, 13});
      Bytes longer = kExample;
      longer.insert(longer.begin() + static_cast<std::ptrdiff_t>(at), extra);
      EXPECT_GE(decode(decoder, kExample + longer + kExample).size(), 2U) << "at " << at;
    }
  }
}

TEST(StreamDecoder, AHeaderWithinTheDataIsNoFrame) {
  const Bytes frame = framed({29, 19, 5, 13, 19});
  StreamDecoder decoder({29, 13});
  // Joined in the middle, where 19 5 looks like a beginning.
  EXPECT_EQ(decode(decoder, Bytes(frame.begin() + 3, frame.end()) + frame + frame).size(), 2U);
  EXPECT_EQ(decoder.counts().frames, 2U);
}

TEST(StreamDecoder, OtherPacketsThanAskedForAreNoFrame) {
  StreamDecoder decoder({29, 13});
  EXPECT_TRUE(decode(decoder, framed({28, 2, 37, 13, 0})).empty());
  EXPECT_EQ(decoder.counts().bad_layout, 1U);
  EXPECT_TRUE(decode(decoder, framed({29, 2, 37, 12, 0})).empty());
  EXPECT_TRUE(decode(decoder, framed({29, 2, 37})).empty()) << "too short";
}

TEST(StreamDecoder, SaysWhenTheFirstByteCame) {
  StreamDecoder decoder({29, 13});
  double now_s = 0;
  double began_s = -1;
  for (const std::uint8_t byte : Bytes{1, 2, 3} + kExample) {
    if (const Frame* const frame = decoder.push(byte, now_s)) began_s = frame->began_s;
    now_s += 1;
  }
  EXPECT_EQ(began_s, 3);
}

TEST(StreamDecoder, ResetForgetsWhatHasBegun) {
  StreamDecoder decoder({29, 13});
  EXPECT_TRUE(decode(decoder, {19, 5, 29}).empty());
  decoder.reset();
  EXPECT_EQ(decode(decoder, kExample).size(), 1U);
  EXPECT_EQ(decoder.counts().skipped, 0U);
}

}  // namespace
}  // namespace rave::oi
