// SPDX-License-Identifier: Apache-2.0
#include "rave/config/yaml.hpp"

#include <gtest/gtest.h>

namespace rave::config {
namespace {

RawNode tree_of(std::string_view text) {
  Diagnostics diagnostics;
  auto node = parse_yaml(text, "t.yaml", diagnostics);
  EXPECT_TRUE(diagnostics.ok()) << (diagnostics.ok() ? "" : diagnostics.joined().text());
  return node.value_or(RawNode{});
}

TEST(Yaml, PlacesAreThoseOfTheFile) {
  const RawNode node = tree_of("a: 1\nb:\n  - x\n  - {c: 2}\n");
  EXPECT_EQ(node.find("a")->where().text(), "t.yaml:1:4");
  EXPECT_EQ(node.key_where(1).text(), "t.yaml:2:1");
  EXPECT_EQ(node.find("b")->child(0).where().text(), "t.yaml:3:5");
  EXPECT_EQ(node.find("b")->child(1).find("c")->where().text(), "t.yaml:4:9");
}

TEST(Yaml, AnEmptyValueStandsAtItsKey) {
  const RawNode node = tree_of("a:\n\n\nb: 1\n");
  EXPECT_TRUE(node.find("a")->is_null());
  EXPECT_EQ(node.find("a")->where().text(), "t.yaml:1:1");
}

TEST(Yaml, AliasesAreExpanded) {
  const RawNode node = tree_of("a: &x {n: [1, 2]}\nb: *x\n");
  EXPECT_EQ(*node.find("a"), *node.find("b"));
  EXPECT_EQ(node.find("b")->find("n")->size(), 2U);
}

TEST(Yaml, TheWordsOfYaml11AreText) {
  for (const char* word :
       {"yes", "no", "on", "off", "y", "TrUe", "010", "0x1F", "1_000", "12:30"}) {
    const RawNode node = tree_of(std::string("a: ") + word);
    EXPECT_EQ(node.find("a")->as_text(), word);
  }
}

TEST(Yaml, EscapesGiveTextThatReadsBack) {
  const RawNode node = tree_of("a: \"\\_é\\_\\N1\\L\\P\\xFF\\u00e9\\U0001F916\"\n");
  EXPECT_EQ(node.find("a")->as_text(),
            "\u00A0\u00E9\u00A0\xC2\x85"
            "1\u2028\u2029\u00FF\u00E9\U0001F916");
  EXPECT_EQ(tree_of(codec::to_yaml(node)), node) << codec::to_yaml(node);
}

TEST(Yaml, AQuoteIsClosedWhateverStandsInIt) {
  // What the parser puts behind a file to find that out.
  const RawNode node = tree_of("a: \"#end-of-file-2f6c1d\"\n");
  EXPECT_EQ(node.find("a")->as_text(), "#end-of-file-2f6c1d");
}

TEST(Yaml, WrittenTextIsQuotedWhereItMustBe) {
  RawNode node = RawNode::mapping();
  for (const char* word :
       {"plain", "a b", "yes", "3", "", "null", "a: b", "#x", "x\ny", "ü", "-"}) {
    node.set(fmt::format("k{}", node.size()), RawNode::text(word));
  }
  EXPECT_EQ(codec::to_yaml(node),
            "k0: plain\nk1: \"a b\"\nk2: \"yes\"\nk3: \"3\"\nk4: \"\"\nk5: \"null\"\n"
            "k6: \"a: b\"\nk7: \"#x\"\nk8: \"x\\ny\"\nk9: \"ü\"\nk10: \"-\"\n");
  EXPECT_EQ(tree_of(codec::to_yaml(node)), node);
}

TEST(Yaml, NestedBlocksReadBack) {
  const RawNode node = tree_of(
      "a:\n  - b: {c: 1, d: [1, {e: 2}]}\n    f: []\n  -\n    - {g: 3}\n    - [x, \"4\"]\n  - ~\n");
  const std::string text = codec::to_yaml(node);
  EXPECT_EQ(tree_of(text), node) << text;
  EXPECT_EQ(codec::to_yaml(tree_of(text)), text);
}

TEST(Yaml, ShortItemsOfListsHaveOneLine) {
  RawNode node = tree_of("a: [{b: 1, \"c d\": [2, x], e: ~}, {f: {g: 1}}]\n");
  EXPECT_EQ(to_yaml(node), "a:\n  - {b: 1, \"c d\": [2, x], e: null}\n  - f:\n      g: 1\n");
  node.child(0).child(0).append("h", RawNode::integer(1), "said");
  EXPECT_NE(to_yaml(node).find("\n    h: 1  # said\n"), std::string::npos) << to_yaml(node);
}

TEST(Yaml, CommentsStandBehindTheLineOrAboveIt) {
  RawNode node = RawNode::mapping();
  node.append("a", RawNode::integer(1), "short");
  node.append("b", RawNode::integer(2), std::string(120, 'x'));
  EXPECT_EQ(codec::to_yaml(node), "a: 1  # short\n# " + std::string(120, 'x') + "\nb: 2\n");
}

TEST(Yaml, JsonIsOrderedAndIndented) {
  const RawNode node = tree_of("z: 1.50\na: [true, .inf, \"3\", 18446744073709551615]\nm: {}\n");
  EXPECT_EQ(codec::to_json(node),
            "{\n  \"z\": 1.5,\n  \"a\": [\n    true,\n    null,\n    \"3\",\n"
            "    18446744073709551615\n  ],\n  \"m\": {}\n}\n");
}

}  // namespace
}  // namespace rave::config
