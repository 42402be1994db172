// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/scip_decoder.hpp"

#include <gtest/gtest.h>

#include "dialogue.hpp"

namespace rave::scip {
namespace {

const std::string kStart =
    "QT\n00P\n\n"
    "SCIP2.0\n0\n\n"
    "RS\n00P\n\n"
    "VV\n00P\nPROT:SCIP 2.0;N\nSERI:H0614967;V\n\n"
    "MD0044072501000\n00P\n\n";

TEST(Decoder, ReadsADialogue) {
  ScipDecoder decoder;
  const auto replies = feed(decoder, kStart);
  ASSERT_EQ(replies.size(), 5U);
  EXPECT_EQ(replies[0], (Kept{"QT", "00", {}}));
  EXPECT_EQ(replies[1], (Kept{"SCIP2.0", "0", {}}));
  EXPECT_EQ(replies[3], (Kept{"VV", "00", {"PROT:SCIP 2.0", "SERI:H0614967"}}));
  EXPECT_EQ(replies[4].echo, "MD0044072501000");
  EXPECT_TRUE(decoder.between_replies());
  EXPECT_EQ(decoder.counts().replies, 5U);
  EXPECT_EQ(decoder.counts().bad_checksum + decoder.counts().malformed, 0U);
}

TEST(Decoder, AWrongChecksumCostsOneReply) {
  for (const char* wrong : {"VV\n00Q\nPROT:SCIP 2.0;N\n\n", "VV\n00P\nPROT:SCIP 2.1;N\n\n"}) {
    ScipDecoder decoder;
    const auto replies = feed(decoder, std::string(wrong) + "QT\n00P\n\n");
    ASSERT_EQ(replies.size(), 1U) << wrong;
    EXPECT_EQ(replies[0].echo, "QT");
    EXPECT_EQ(decoder.counts().bad_checksum, 1U);
  }
}

TEST(Decoder, EverySingleWrongByteOfAScanIsFound) {
  const std::vector<unsigned> ranges = {1000, 4095, 20,   0,    70'000, 1234, 99,   5600,
                                        3000, 17,   8,    2000, 2001,   2002, 2003, 2004,
                                        2005, 2006, 2007, 2008, 1,      2009, 2010, 3};
  const std::string scan = scan_text("MD0000002301000", "99", 12'345'678, ranges, 3);
  ScipDecoder good;
  const auto truth = feed(good, scan);
  ASSERT_EQ(truth.size(), 1U);
  const std::size_t data = scan.find('\n') + 1;  // the echo bears no checksum
  for (std::size_t at = data; at < scan.size(); ++at) {
    for (int change = 1; change < 256; ++change) {
      std::string wrong = scan;
      wrong[at] = static_cast<char>(static_cast<unsigned char>(wrong[at]) ^ change);
      ScipDecoder decoder;
      for (const Kept& reply : feed(decoder, wrong + "\n\n")) {
        // A changed checksum digit or bit above the six can pass here; the alphabet and the shape
        // are checked by whoever reads the ranges. Nothing that stays in the alphabet passes.
        bool in_alphabet = reply.status == "99" && reply.lines.size() == truth[0].lines.size();
        for (std::size_t i = 0; in_alphabet && i < reply.lines.size(); ++i) {
          in_alphabet = reply.lines[i].size() == truth[0].lines[i].size();
          for (const char c : reply.lines[i]) in_alphabet = in_alphabet && c >= 0x30 && c < 0x70;
        }
        EXPECT_FALSE(in_alphabet && reply.lines != truth[0].lines) << at << ' ' << change;
      }
    }
  }
}

TEST(Decoder, FindsItsWayBackAfterGarbage) {
  ScipDecoder decoder;
  const auto replies = feed(decoder, std::string("\x00\xff;;%\n99\nx\n", 10) + "\n\n\n" + kStart);
  EXPECT_EQ(replies.size(), 5U);
}

TEST(Decoder, ATornReplyTakesAtMostTheNextWithIt) {
  for (std::size_t cut = 1; cut < kStart.size(); ++cut) {
    ScipDecoder decoder;
    const auto replies = feed(decoder, kStart.substr(cut) + kStart);
    ASSERT_GE(replies.size(), 4U) << cut;
    EXPECT_EQ(replies.back().echo, "MD0044072501000") << cut;
  }
}

TEST(Decoder, EndlessLinesAndRepliesTakeNoMemory) {
  ScipDecoder decoder;
  EXPECT_TRUE(feed(decoder, std::string(100'000, 'x')).empty());
  EXPECT_EQ(decoder.counts().malformed, 1U);
  std::string lines = "\n\n";
  for (int i = 0; i < 10'000; ++i) lines += "0P\n";
  EXPECT_TRUE(feed(decoder, lines).empty());
  EXPECT_EQ(decoder.counts().malformed, 2U);
  EXPECT_EQ(feed(decoder, "\n" + kStart).size(), 5U);
}

TEST(Decoder, TellsWhereAReplyBegins) {
  ScipDecoder decoder;
  EXPECT_TRUE(decoder.between_replies());
  feed(decoder, "Q");
  EXPECT_FALSE(decoder.between_replies());
  feed(decoder, "T\n00P\n");
  EXPECT_FALSE(decoder.between_replies());
  feed(decoder, "\n");
  EXPECT_TRUE(decoder.between_replies());
  feed(decoder, "Q");
  decoder.reset();
  EXPECT_TRUE(decoder.between_replies());
}

}  // namespace
}  // namespace rave::scip
