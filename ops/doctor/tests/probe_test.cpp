// SPDX-License-Identifier: Apache-2.0
#include "rave/doctor/probe.hpp"

#include <gtest/gtest.h>

namespace rave::doctor {
namespace {

Probe answer() {
  Probe probe;
  probe.kind = Probe::Kind::kAnswer;
  probe.number = UINT64_MAX;
  probe.size = 1200;
  probe.sent_ns = -5;
  probe.received_ns = 1'800'000'000'000'000'000;
  probe.about = {"lab-1", "0.1.0",         UINT64_MAX, 7,    "none",
                 "3F:09", "rave doctor 1", 7410,       7411, true};
  return probe;
}

TEST(Probe, ComesBackAsItWasWritten) {
  for (const Probe& probe : {Probe{}, answer()}) {
    const auto read = parse_probe(write_probe(probe));
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(*read, probe);
  }
}

TEST(Probe, IsAsLongAsItIsWanted) {
  EXPECT_EQ(write_probe({}, 32'000).size(), 32'000U);
  EXPECT_EQ(write_probe({}, 1'000'000).size(), kLargestProbe);
  EXPECT_TRUE(parse_probe(write_probe(answer(), 64'000)));
}

std::string reason(std::string_view bytes) {
  const auto probe = parse_probe(bytes);
  if (probe) return "read";
  const std::string& message = probe.error().message;
  return message.substr(message.find(": ") + 2);
}

TEST(Probe, WhatIsNoneIsRefused) {
  EXPECT_EQ(reason(""), "it is not JSON");
  EXPECT_EQ(reason("RTPS"), "it is not JSON");
  EXPECT_EQ(reason("[[[[[["), "it is nested");
  EXPECT_EQ(reason("{}"), "a field is missing or of another type");
  EXPECT_EQ(reason("7"), "a field is missing or of another type");
  const std::string good = write_probe(answer());
  const auto with = [&](std::string_view from, std::string_view to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(reason(good), "read");
  EXPECT_EQ(reason(with("\"rave_doctor\":1", "\"rave_doctor\":2")), "its version differs");
  EXPECT_EQ(reason(with("\"answer\"", "\"anwser\"")), "its kind is unknown");
  EXPECT_EQ(reason(with("\"size\":1200", "\"size\":-1")), "a field is missing or of another type");
  EXPECT_EQ(reason(with("\"sent_ns\":-5", "\"sent_ns\":9e99")),
            "a field is missing or of another type");
  EXPECT_EQ(reason(with("\"sent_ns\":-5", "\"sent_ns\":9223372036854775807")),
            "a field is missing or of another type");
  EXPECT_EQ(reason(with("lab-1", "lab\\u001bJ")), "members are missing or invalid")
      << "control characters";
  EXPECT_EQ(reason(with("lab-1", "lab\\u009bJ")), "members are missing or invalid");
  EXPECT_EQ(reason(with("7411", "74110")), "members are missing or invalid");
}

}  // namespace
}  // namespace rave::doctor
