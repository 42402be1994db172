// SPDX-License-Identifier: Apache-2.0
#include "rave/codec/raw_node.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "rave/config/yaml.hpp"

namespace rave::config {
namespace {

TEST(RawNode, ScalarsHaveOneTypeEach) {
  EXPECT_EQ(RawNode::plain("3").as_int(), 3);
  EXPECT_EQ(RawNode::plain("+3").as_uint(), 3U);
  EXPECT_EQ(RawNode::plain("3").as_double(), 3.0);
  EXPECT_EQ(RawNode::plain("3.0").as_int(), std::nullopt);
  EXPECT_EQ(RawNode::plain("-.5e-3").as_double(), -0.0005);
  EXPECT_EQ(RawNode::plain(".").as_text(), ".");
  EXPECT_EQ(RawNode::plain("1e").as_text(), "1e");
  EXPECT_EQ(RawNode::text("3").as_int(), std::nullopt);
  EXPECT_EQ(RawNode::text("3").as_text(), "3");
  EXPECT_EQ(RawNode::plain("true").as_bool(), true);
  for (const char* const word : {"True", "TRUE"}) {
    EXPECT_EQ(RawNode::plain(word).as_bool(), true) << word;
    EXPECT_EQ(RawNode::text(word).as_bool(), std::nullopt) << word;
    EXPECT_EQ(to_json_line(RawNode::plain(word)), "true") << word;
  }
  for (const char* const word : {"false", "False", "FALSE"}) {
    EXPECT_EQ(RawNode::plain(word).as_bool(), false) << word;
    EXPECT_EQ(to_json_line(RawNode::plain(word)), "false") << word;
  }
  EXPECT_EQ(RawNode::plain("TrUe").as_text(), "TrUe");
  EXPECT_EQ(RawNode::plain("true").as_text(), std::nullopt);
  EXPECT_TRUE(RawNode::plain("~").is_null());
  EXPECT_FALSE(RawNode::text("~").is_null());
}

TEST(RawNode, DoublesAreShortAndExact) {
  const auto text = [](double value) { return RawNode::number(value).scalar(); };
  EXPECT_EQ(text(0.1), "0.1");
  EXPECT_EQ(text(8), "8");
  EXPECT_EQ(text(1e21), "1.0e+21");
  EXPECT_EQ(text(1.5e-300), "1.5e-300");
  EXPECT_EQ(text(-std::numeric_limits<double>::infinity()), "-.inf");
  for (const double value :
       {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -0.0, 1e22, 123456789.125}) {
    const auto again = RawNode::plain(text(value)).as_double();
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(*again, value);
    EXPECT_EQ(std::signbit(*again), std::signbit(value));
  }
}

TEST(RawNode, CopiesAreDeep) {
  RawNode a = RawNode::mapping();
  a.append("list", RawNode::sequence());
  RawNode b = a;
  b.child(0).push_back(RawNode::integer(1));
  EXPECT_EQ(a.find("list")->size(), 0U);
  EXPECT_EQ(b.find("list")->size(), 1U);
  EXPECT_FALSE(a == b);
}

TEST(RawNode, EntriesAreSetAndErased) {
  RawNode node = RawNode::mapping();
  node.set("a", RawNode::integer(1));
  node.set("b", RawNode::integer(2));
  node.set("a", RawNode::integer(3));
  EXPECT_EQ(codec::to_yaml(node), "a: 3\nb: 2\n");
  EXPECT_TRUE(node.erase("a"));
  EXPECT_FALSE(node.erase("a"));
  EXPECT_EQ(node.keys(), std::vector<std::string_view>{"b"});
}

TEST(RawNode, SaysWhatItIs) {
  EXPECT_EQ(RawNode{}.found_text(), "nothing");
  EXPECT_EQ(RawNode::text("3").found_text(), "the text \"3\"");
  EXPECT_EQ(RawNode::plain("3").found_text(), "the number 3");
  EXPECT_EQ(RawNode::boolean(true).found_text(), "true");
  EXPECT_EQ(RawNode::text(std::string(39, 'a') + "üb").found_text(),
            "the text \"" + std::string(39, 'a') + "...\"");
  EXPECT_EQ(RawNode::sequence().found_text(), "a list");
  EXPECT_EQ(RawNode::mapping().found_text(), "a mapping");
}

}  // namespace
}  // namespace rave::config
