// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/request_parts.hpp"

#include <gtest/gtest.h>

#include "rave/base/control_characters.hpp"
#include "rave/bus/topics.hpp"

namespace rave::bus {
namespace {

constexpr std::size_t kMessage = rave_wire_kMaxRequestAnswerBytes;

std::string reason(const Status& status) { return status ? "accepted" : status.error().message; }

TEST(RequestParts, WhatFitsGoesAsItIs) {
  const std::string answer(kMessage, 'x');
  EXPECT_EQ(answer_part(answer, 0), answer);
  EXPECT_EQ(answer_part(answer, kMessage), std::nullopt);
  AnswerParts parts;
  EXPECT_FALSE(parts.complete());
  ASSERT_EQ(reason(parts.add(answer)), "accepted");
  EXPECT_TRUE(parts.complete());
  EXPECT_EQ(parts.text(), answer);
}

TEST(RequestParts, ALongAnswerIsPutTogetherAndNoCharacterIsCut) {
  // Of three bytes each, begun at each of the three places.
  for (const char* const start : {"", "a", "ab"}) {
    std::string answer = start;
    while (answer.size() < 3 * kMessage) answer += "\u2265";
    AnswerParts parts;
    int messages = 0;
    while (!parts.complete() && messages < 10) {
      const auto part = answer_part(answer, parts.text().size());
      ASSERT_TRUE(part);
      EXPECT_LE(part->size(), kMessage);
      EXPECT_FALSE(has_control_characters(*part)) << "a character was cut";
      ASSERT_EQ(reason(parts.add(*part)), "accepted");
      // Sent again.
      ASSERT_EQ(reason(parts.add(*part)), "accepted");
      ++messages;
    }
    EXPECT_EQ(messages, 4);
    EXPECT_EQ(parts.text(), answer);
  }
}

TEST(RequestParts, ARequestForTheRestSaysWhereItBegins) {
  EXPECT_EQ(request_for_rest(262'080), "from 262080");
  EXPECT_EQ(rest_requested("from 262080"), 262'080U);
  for (const char* const other : {"", "from ", "from -1", "from 7 ", "from 7x", "{\"rave\":1}",
                                  "from 99999999999999999999999999"}) {
    EXPECT_EQ(rest_requested(other), 0U) << other;
  }
}

TEST(RequestParts, GarbageIsRefused) {
  const std::string answer(2 * kMessage, 'x');
  const std::string first = *answer_part(answer, 0);
  AnswerParts parts;
  EXPECT_NE(reason(parts.add("")).find("0 bytes are not within"), std::string::npos);
  EXPECT_NE(reason(parts.add("from 0 of 8388609: x")).find("8388609 bytes are not within"),
            std::string::npos);
  EXPECT_NE(reason(parts.add("from 0 of 0: ")).find("not within"), std::string::npos);
  for (const char* const heading : {"from ", "from x of 9: x", "from 0 of -1: x", "from 0 of 9",
                                    "from 0, of 9: x", "from 0 of 99999999999999999999999: x"}) {
    EXPECT_NE(reason(parts.add(heading)).find("header"), std::string::npos) << heading;
  }
  EXPECT_NE(reason(parts.add("from 1 of 9: x")).find("at byte 1 instead of 0"), std::string::npos);
  EXPECT_NE(reason(parts.add("from 0 of 9: x")).find("has 1 bytes of 9"), std::string::npos);
  EXPECT_NE(reason(parts.add("from 0 of 2: xyz")).find("has 3 bytes of 2"), std::string::npos);
  EXPECT_NE(reason(parts.add("from 0 of 524288: x")).find("has 1 bytes of"), std::string::npos);
  EXPECT_TRUE(parts.text().empty());
  ASSERT_EQ(reason(parts.add(first)), "accepted");
  const std::size_t had = parts.text().size();
  EXPECT_NE(reason(parts.add("from 300000 of 524288: x")).find("at byte 300000"),
            std::string::npos);
  EXPECT_NE(reason(parts.add("from 262080 of 524289: x")).find("and the others of 524288"),
            std::string::npos);
  EXPECT_NE(reason(parts.add("from 18446744073709551615 of 524288: x")).find("at byte 184467"),
            std::string::npos);
  EXPECT_EQ(parts.text().size(), had);
  EXPECT_FALSE(parts.complete());
}

}  // namespace
}  // namespace rave::bus
