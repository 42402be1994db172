// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/host_results.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "rave/base/hash.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/validate.hpp"

namespace rave::lock_step {
namespace {

constexpr std::size_t kPart = rave_wire_kMaxHostResultsPart;

/// What a host would send, cut as it cuts it.
struct Sent {
  std::vector<std::byte> bytes;
  std::vector<std::vector<std::uint8_t>> pieces;
  std::vector<bus::HostResultsPart> parts;

  Sent(std::uint64_t writer, std::uint32_t host, std::size_t size) : bytes(size) {
    for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(i * 7 + host);
    for (std::size_t at = 0; at < size; at += kPart) {
      std::vector<std::uint8_t>& piece = pieces.emplace_back();
      for (std::size_t i = at; i < std::min(size, at + kPart); ++i) {
        piece.push_back(static_cast<std::uint8_t>(bytes[i]));
      }
    }
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      bus::HostResultsPart& part = parts.emplace_back();
      part.writer = writer;
      part.part = static_cast<std::uint32_t>(p);
      part.host = host;
      part.size = size;
      part.hash = content_hash(bytes);
      bus::borrow(part.bytes, pieces[p]);
    }
  }
  Sent(const Sent&) = delete;
  Sent& operator=(const Sent&) = delete;
};

TEST(HostResults, ComeTogetherInAnyOrderAndOnce) {
  const Sent one(11, 0, 2 * kPart + 5);
  const Sent two(12, 1, 3);
  HostResultsParts parts;
  for (const bus::HostResultsPart& part : one.parts) EXPECT_TRUE(bus::validate(part));
  EXPECT_TRUE(parts.add(one.parts[2]));
  EXPECT_TRUE(parts.add(one.parts[2])) << "twice is once";
  EXPECT_TRUE(parts.add(two.parts[0]));
  EXPECT_TRUE(parts.done_with(12));
  EXPECT_TRUE(parts.add(one.parts[0]));
  EXPECT_FALSE(parts.done_with(11));
  EXPECT_TRUE(parts.add(one.parts[1]));
  EXPECT_TRUE(parts.done_with(11));
  const auto whole = parts.hand_out();
  ASSERT_EQ(whole.size(), 2U);
  EXPECT_EQ(whole[0].host, 1U);
  EXPECT_EQ(whole[0].bytes, two.bytes);
  EXPECT_EQ(whole[1].writer, 11U);
  EXPECT_EQ(whole[1].bytes, one.bytes);
  EXPECT_TRUE(parts.add(one.parts[1]));
  EXPECT_TRUE(parts.hand_out().empty());
}

TEST(HostResults, OfWhichAByteIsAnotherAreRefused) {
  Sent sent(11, 4, kPart + 9);
  sent.pieces[1][3] ^= 1;
  HostResultsParts parts;
  EXPECT_TRUE(parts.add(sent.parts[0]));
  const Status last = parts.add(sent.parts[1]);
  ASSERT_FALSE(last);
  EXPECT_NE(last.error().message.find("host 4 do not match their checksum"), std::string::npos);
  EXPECT_TRUE(parts.done_with(11)) << "nobody waits for them";
  EXPECT_TRUE(parts.hand_out().empty());
}

TEST(HostResults, ThatContradictThemselvesAreRefused) {
  Sent sent(11, 4, kPart + 9);
  HostResultsParts parts;
  EXPECT_TRUE(parts.add(sent.parts[0]));
  sent.parts[1].host = 5;
  const Status other = parts.add(sent.parts[1]);
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("of host 5"), std::string::npos) << other.error().message;
  sent.parts[1].host = 4;
  EXPECT_TRUE(parts.add(sent.parts[1]));
  EXPECT_EQ(parts.hand_out().size(), 1U);
}

TEST(HostResults, AreAsLongAsTheySay) {
  Sent sent(11, 0, kPart + 9);
  const auto reason = [](const bus::HostResultsPart& part) {
    const Status status = bus::validate(part);
    return status ? "accepted" : status.error().message;
  };
  bus::HostResultsPart part = sent.parts[1];
  EXPECT_EQ(reason(part), "accepted");
  part.part = 2;
  EXPECT_EQ(reason(part), "part is 2, but 262153 bytes have 2 parts");
  part.part = 0;
  EXPECT_EQ(reason(part), "bytes has 9 entries in part 0, not 262144");
  part.size = 0;
  EXPECT_NE(reason(part).find("size is 0"), std::string::npos) << reason(part);
  part.size = kMostHostResults + 1;
  EXPECT_NE(reason(part).find("size is 268435457"), std::string::npos) << reason(part);
  part = sent.parts[1];
  part.writer = 0;
  EXPECT_EQ(reason(part), "writer is 0");
  part.writer = 1;
  part.host = rave_wire_kNone;
  EXPECT_EQ(reason(part), "host is none");
}

}  // namespace
}  // namespace rave::lock_step
