// SPDX-License-Identifier: Apache-2.0
#include "rave/doctor/letter.hpp"

#include <gtest/gtest.h>

namespace rave::doctor {
namespace {

Letter answer() {
  Letter letter;
  letter.kind = Letter::Kind::kAnswer;
  letter.number = UINT64_MAX;
  letter.size = 1200;
  letter.sent_ns = -5;
  letter.received_ns = 1'800'000'000'000'000'000;
  letter.about = {"lab-1", "0.1.0",         UINT64_MAX, 7,    "off",
                  "3F:09", "rave doctor 1", 7410,       7411, true};
  return letter;
}

TEST(Letter, ComesBackAsItWasWritten) {
  for (const Letter& letter : {Letter{}, answer()}) {
    const auto read = parse_letter(write_letter(letter));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, letter);
  }
}

TEST(Letter, IsAsLongAsItIsWanted) {
  EXPECT_EQ(write_letter({}, 32'000).size(), 32'000U);
  EXPECT_EQ(write_letter({}, 1'000'000).size(), kLargestLetter);
  EXPECT_TRUE(parse_letter(write_letter(answer(), 64'000)));
}

std::string reason(std::string_view bytes) {
  const auto letter = parse_letter(bytes);
  return letter ? "read" : letter.error().message.substr(31);
}

TEST(Letter, WhatIsNoneIsRefused) {
  EXPECT_EQ(reason(""), "it is not JSON");
  EXPECT_EQ(reason("RTPS"), "it is not JSON");
  EXPECT_EQ(reason("[[[[[["), "it is nested");
  EXPECT_EQ(reason("{}"), "a field is missing or of another type");
  EXPECT_EQ(reason("7"), "a field is missing or of another type");
  const std::string good = write_letter(answer());
  const auto with = [&](std::string_view from, std::string_view to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(reason(good), "read");
  EXPECT_EQ(reason(with("\"rave_doctor\":1", "\"rave_doctor\":2")), "it is of another version");
  EXPECT_EQ(reason(with("\"answer\"", "\"anwser\"")), "its kind is not known");
  EXPECT_EQ(reason(with("\"size\":1200", "\"size\":-1")), "a field is missing or of another type");
  EXPECT_EQ(reason(with("\"sent_ns\":-5", "\"sent_ns\":9e99")),
            "a field is missing or of another type");
  EXPECT_EQ(reason(with("\"sent_ns\":-5", "\"sent_ns\":9223372036854775807")),
            "a field is missing or of another type");
  EXPECT_EQ(reason(with("lab-1", "lab\\u001bJ")), "it says too little") << "control characters";
  EXPECT_EQ(reason(with("lab-1", "lab\\u009bJ")), "it says too little");
  EXPECT_EQ(reason(with("7411", "74110")), "it says too little");
}

}  // namespace
}  // namespace rave::doctor
