// SPDX-License-Identifier: Apache-2.0
#include "rave/codec/json_input.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "rave/codec/text_output.hpp"

namespace rave::codec {
namespace {

std::string error_of(std::string_view text, const JsonLimits& limits = {}) {
  const auto node = parse_json(text, limits);
  return node ? "read: " + to_json_line(*node) : node.error().message;
}

TEST(JsonInput, ReadsWhatItWrites) {
  for (const char* const text :
       {"null", "true", R"("a \"b\" c")", "[]", "{}", "[1, -2, 0.5, 18446744073709551615]",
        R"({"a": {"b": [1, {"c": null}]}, "d": "1"})"}) {
    const auto node = parse_json(text);
    ASSERT_TRUE(node.has_value()) << text;
    EXPECT_EQ(to_json_line(*node), text);
  }
}

TEST(JsonInput, NumbersKeepTheirBits) {
  const auto node = parse_json("[0.1, 1e-300, 5e-324, -0.0]");
  ASSERT_TRUE(node.has_value());
  EXPECT_EQ(node->child(0).as_double(), 0.1);
  EXPECT_EQ(node->child(1).as_double(), 1e-300);
  EXPECT_EQ(node->child(2).as_double(), 5e-324);
  EXPECT_TRUE(std::signbit(*node->child(3).as_double()));
}

TEST(JsonInput, TextsAreNoNumbers) {
  const auto node = parse_json(R"({"a": "3"})");
  ASSERT_TRUE(node.has_value());
  EXPECT_EQ(node->find("a")->as_int(), std::nullopt);
  EXPECT_EQ(node->find("a")->as_text(), "3");
}

TEST(JsonInput, RefusesWithReasons) {
  EXPECT_EQ(error_of(R"({"a": 1, "a": 2})"), "the key `a` stands twice");
  EXPECT_EQ(error_of("1e999"), "a number is too large");
  EXPECT_EQ(error_of("{a: 1}"), "no JSON: unexpected at byte 2");
  EXPECT_EQ(error_of(""), "no JSON: unexpected at byte 1");
  EXPECT_EQ(error_of("1 2"), "no JSON: unexpected at byte 3");
  EXPECT_EQ(error_of("\"\xff\""), "no JSON: unexpected at byte 2");
  EXPECT_EQ(error_of("[[[1]]]", {.depth = 2}), "nested deeper than 2");
  EXPECT_EQ(error_of("[1, 2, 3]", {.nodes = 2}), "more than 2 values");
}

}  // namespace
}  // namespace rave::codec
