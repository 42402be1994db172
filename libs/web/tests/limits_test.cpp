// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "rave/web/message.hpp"
#include "rave/web/rate_limit.hpp"

namespace rave::web {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const RateLimit::Clock::time_point kStart{seconds(1000)};

TEST(RateLimit, LetsABurstThroughAndThenItsRate) {
  RateLimit limit(2, 3);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(limit.take("a", kStart));
  EXPECT_FALSE(limit.take("a", kStart));
  EXPECT_TRUE(limit.take("b", kStart));
  EXPECT_FALSE(limit.take("a", kStart + milliseconds(400)));
  EXPECT_TRUE(limit.take("a", kStart + milliseconds(600)));
  // A long pause does not save up more than the burst.
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(limit.take("a", kStart + seconds(100)));
  EXPECT_FALSE(limit.take("a", kStart + seconds(100)));
}

TEST(RateLimit, LooksWithoutTaking) {
  RateLimit limit(1, 1);
  EXPECT_TRUE(limit.has("a", kStart));
  EXPECT_TRUE(limit.has("a", kStart));
  EXPECT_TRUE(limit.take("a", kStart));
  EXPECT_FALSE(limit.has("a", kStart));
  EXPECT_TRUE(limit.has("a", kStart + seconds(2)));
}

TEST(RateLimit, RemembersABoundedNumberOfNames) {
  RateLimit limit(0.001, 1);
  for (int i = 0; i < 30'000; ++i) static_cast<void>(limit.take(std::to_string(i), kStart));
  EXPECT_LE(limit.size(), 10'000U);
}

TEST(Network, IsAnAddressOrTheFirstHalfOfALongOne) {
  EXPECT_EQ(network_of("192.168.1.20"), "192.168.1.20");
  EXPECT_EQ(network_of("::ffff:192.168.1.20"), "192.168.1.20");
  EXPECT_EQ(network_of("2001:db8:1:2:aaaa::1"), "2001:db8:1:2::/64");
  EXPECT_EQ(network_of("2001:db8:1:2:bbbb::9"), "2001:db8:1:2::/64");
  EXPECT_EQ(network_of("fe80::1%eth0"), "fe80::/64");
  EXPECT_EQ(network_of(""), "");
  EXPECT_TRUE(is_loopback("127.0.0.1"));
  EXPECT_TRUE(is_loopback("::1"));
  EXPECT_TRUE(is_loopback("::ffff:127.0.0.1"));
  EXPECT_FALSE(is_loopback("192.168.1.20"));
  EXPECT_FALSE(is_loopback(""));
}

TEST(Form, IsTakenApart) {
  std::map<std::string, std::string> fields;
  ASSERT_TRUE(parse_form("name=ada&password=a%26b+c&name=eve", fields));
  EXPECT_EQ(fields["name"], "ada");
  EXPECT_EQ(fields["password"], "a&b c");
  EXPECT_TRUE(parse_form("", fields));
  EXPECT_TRUE(fields.empty());
}

TEST(Form, WhatIsMalformedOrTooMuchIsRefused) {
  std::map<std::string, std::string> fields;
  EXPECT_FALSE(parse_form("name=%0a", fields));
  EXPECT_FALSE(parse_form("name=%4", fields));
  EXPECT_FALSE(parse_form("name=" + std::string(9000, 'x'), fields));
  std::string many;
  for (int i = 0; i < 40; ++i) many += "a" + std::to_string(i) + "=1&";
  EXPECT_FALSE(parse_form(many, fields));
}

}  // namespace
}  // namespace rave::web
