// SPDX-License-Identifier: Apache-2.0
#include "rave/codec/variant_codec.hpp"

#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "rave/codec/nodes.hpp"

namespace rave::codec {
namespace {

struct Go {
  static constexpr std::string_view kName = "go";
  double x_m = 0;
  bool operator==(const Go&) const = default;
};
struct Wait {
  static constexpr std::string_view kName = "wait";
  bool operator==(const Wait&) const = default;
};
template <class V>
void describe(V& v, Go& c) {
  v.required("x_m", c.x_m, {.doc = "Where to.", .max = 10, .unit = "m"});
}
template <class V>
void describe(V&, Wait&) {}

using Step = std::variant<Wait, Go>;

std::string step_error(std::string_view json) {
  const auto step = from_json<Step>(json);
  return step ? "read: " + to_json_line(*step) : step.error().message;
}

TEST(VariantCodec, ReadsWhatItWrites) {
  EXPECT_EQ(to_json_line(Step(Go{2.5})), R"({"do": "go", "x_m": 2.5})");
  EXPECT_EQ(to_json_line(Step(Wait{})), R"({"do": "wait"})");
  for (const Step& step : {Step(Go{-1}), Step(Wait{})}) {
    const auto again = from_json<Step>(to_json_line(step));
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(*again, step);
  }
  EXPECT_EQ(name_of(Step(Go{})), "go");
}

TEST(VariantCodec, RefusesWithReasons) {
  EXPECT_EQ(step_error(R"({"x_m": 1})"), "missing key `do`: expected one of wait and go");
  EXPECT_EQ(step_error(R"({"do": "goo", "x_m": 1})"),
            "`do`: found the text \"goo\", expected one of wait and go; did you mean `go`?");
  EXPECT_EQ(step_error(R"({"do": "go"})"),
            "missing key `x_m`: expected a number (at most 10, in metres)");
  EXPECT_EQ(step_error(R"({"do": "wait", "x_m": 1})"), "unknown key `x_m`; there are none");
  EXPECT_EQ(step_error(R"({"do": "go", "x_m": 11})"),
            "`x_m`: found the number 11, expected a number (at most 10, in metres)");
  EXPECT_EQ(step_error("[]"), "found a list, expected a mapping");
}

TEST(VariantCodec, SchemaHasEachWithItsName) {
  const std::string schema = to_json_line(Codec<Step>::schema({}));
  EXPECT_NE(schema.find(R"("do": {"const": "go"})"), std::string::npos) << schema;
  EXPECT_NE(schema.find(R"("required": ["x_m", "do"])"), std::string::npos) << schema;
}

}  // namespace
}  // namespace rave::codec
