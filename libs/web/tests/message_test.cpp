// SPDX-License-Identifier: Apache-2.0
#include "rave/web/message.hpp"

#include <gtest/gtest.h>

namespace rave::web {
namespace {

using Query = std::map<std::string, std::string>;

TEST(Target, IsDecodedAndSplit) {
  std::string path;
  Query query;
  ASSERT_TRUE(parse_target("/a%20b/c.js?x=1&y=%41+z&flag", path, query));
  EXPECT_EQ(path, "/a b/c.js");
  EXPECT_EQ(query, (Query{{"x", "1"}, {"y", "A z"}, {"flag", ""}}));
}

TEST(Target, TheFirstOfEqualNamesCounts) {
  std::string path;
  Query query;
  ASSERT_TRUE(parse_target("/enter?key=mine&key=theirs", path, query));
  EXPECT_EQ(query["key"], "mine");
}

class BadTarget : public testing::TestWithParam<const char*> {};

TEST_P(BadTarget, IsRefused) {
  std::string path;
  Query query;
  EXPECT_FALSE(parse_target(GetParam(), path, query)) << path;
}

INSTANTIATE_TEST_SUITE_P(All, BadTarget,
                         testing::Values("", "index.html", "http://other/", "/..", "/../etc/passwd",
                                         "/a/../b", "/%2e%2e/etc", "/a/%2E%2e", "/./a", "/a/.",
                                         "/..\\..\\x", "/a%5cb", "/%", "/%4", "/%zz", "/%00",
                                         "/a%0d%0aSet-Cookie:x", "/?a=%", "/?%0a=1"));

TEST(Cookie, IsFoundByItsWholeName) {
  Request request;
  request.headers["cookie"] = "a=1; rave_80=no; rave_8080=yes; b=";
  EXPECT_EQ(request.cookie("rave_8080"), "yes");
  EXPECT_EQ(request.cookie("rave_80"), "no");
  EXPECT_EQ(request.cookie("b"), "");
  EXPECT_EQ(request.cookie("rave"), "");
}

}  // namespace
}  // namespace rave::web
