// SPDX-License-Identifier: Apache-2.0
#include "rave/script/value.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rave::script {
namespace {

Value sample() {
  return Value::Table{{std::int64_t{1}, Value(0.1)},
                      {std::int64_t{7}, Value(std::numeric_limits<double>::quiet_NaN())},
                      {"list", Value::Table{{std::int64_t{1}, Value("ä\0b")}}},
                      {"on", Value(true)}};
}

TEST(Value, BytesGiveTheSameValue) {
  for (const Value& value : {sample(), Value(), Value(-0.0), Value(std::int64_t{-5}), Value("")}) {
    const auto again = read_value(write_value(value));
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(*again, value);
  }
  EXPECT_FALSE(Value(0.0) == Value(-0.0));
}

TEST(Value, RefusesDamagedBytes) {
  const auto bytes = write_value(sample());
  for (std::size_t cut = 0; cut < bytes.size(); ++cut) {
    EXPECT_FALSE(read_value(std::span(bytes).first(cut)).has_value()) << cut;
  }
  auto longer = bytes;
  longer.push_back(std::byte{0});
  EXPECT_FALSE(read_value(longer).has_value());
  const Value unsorted = Value::Table{{"b", Value(1.0)}, {"a", Value(1.0)}};
  EXPECT_FALSE(read_value(write_value(unsorted)).has_value());
}

TEST(Value, FindsKeys) {
  const Value value = sample();
  EXPECT_EQ(*value.find("on"), Value(true));
  EXPECT_EQ(*value.find(1), Value(0.1));
  EXPECT_EQ(value.find("off"), nullptr);
  EXPECT_EQ(Value(1.0).find("on"), nullptr);
  EXPECT_FALSE(Value(false).holds());
  EXPECT_TRUE(Value(0.0).holds());
}

}  // namespace
}  // namespace rave::script
