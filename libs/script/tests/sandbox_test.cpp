// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "rave/math/trigonometry.hpp"
#include "rave/script/script.hpp"

namespace rave::script {
namespace {

/// The value of an expression, or an error as a text.
Value value_of(std::string_view expression, std::string_view source = "") {
  const auto script = Script::load(source, "test.lua", {});
  if (!script) return script.error().text();
  const auto number = (*script)->compile(expression, {"test.yaml", 1, 1});
  if (!number) return number.error().message;
  auto value = (*script)->evaluate(*number);
  return value ? *std::move(value) : Value(value.error().message);
}

TEST(Sandbox, HasNoWayOut) {
  for (const char* const name :
       {"io",         "os",     "debug",    "package",        "require",      "load",
        "loadstring", "dofile", "loadfile", "collectgarbage", "getmetatable", "setmetatable",
        "rawset",     "rawget", "next",     "pcall",          "xpcall",       "coroutine",
        "_G",         "print",  "warn"}) {
    EXPECT_TRUE(value_of(name).text()->starts_with("nothing is called `" + std::string(name) + "`"))
        << name;
  }
  EXPECT_EQ(value_of("string.dump"), Value());
  EXPECT_EQ(value_of("math.random"), Value());
  EXPECT_EQ(value_of("table.sort.x").text() != nullptr, true);
}

TEST(Sandbox, MathIsThatOfTheLibrary) {
  EXPECT_EQ(value_of("math.sin(1.234)"), Value(rave::sin(1.234)));
  EXPECT_EQ(value_of("math.atan(-1, -2)"), Value(rave::atan2(-1, -2)));
  EXPECT_EQ(value_of("math.pow(3, 4)"), Value(81.0));
  EXPECT_EQ(value_of("math.pow(2, -2)"), Value(0.25));
  EXPECT_EQ(value_of("math.pow(2, 0.5)"), Value(std::sqrt(2.0)));
  EXPECT_NEAR(value_of("math.pow(2, 1.5)").number_or(0), std::pow(2.0, 1.5), 1e-12);
  EXPECT_EQ(value_of("math.floor(2.7) // 1"), Value(std::int64_t{2}));
}

TEST(Sandbox, PairsGoInOrder) {
  constexpr std::string_view kSource =
      "function keys(t) local s = '' for k, v in pairs(t) do s = s .. k .. '=' .. tostring(v) .. "
      "' ' end return s end";
  EXPECT_EQ(value_of("keys({b = 1, a = 2, [10] = 3, [2] = 4, 'x', aa = true})", kSource),
            Value("1=x 2=4 10=3 a=2 aa=true b=1 "));
  EXPECT_EQ(value_of("keys(t)", std::string(kSource) + " t = {z = 1, y = 2}"), Value("y=2 z=1 "));
  EXPECT_NE(value_of("keys({[{}] = 1})", kSource).text()->find("have an order"), std::string::npos);
}

TEST(Sandbox, SortIsStable) {
  constexpr std::string_view kSource =
      "function sorted() local t = {} for i = 1, 200 do t[i] = {k = i % 3, i = i} end\n"
      "table.sort(t, function(a, b) return a.k < b.k end)\n"
      "for i = 2, 200 do if t[i - 1].k > t[i].k then return 'unsorted' end\n"
      "if t[i - 1].k == t[i].k and t[i - 1].i > t[i].i then return 'unstable' end end\n"
      "return 'good' end\n"
      "function plain() local t = {3, 1, 2} table.sort(t) return table.concat(t, ' ') end";
  EXPECT_EQ(value_of("sorted()", kSource), Value("good"));
  EXPECT_EQ(value_of("plain()", kSource), Value("1 2 3"));
}

TEST(Sandbox, TextsHaveNoAddresses) {
  EXPECT_EQ(value_of("tostring({}) .. tostring(tostring)"), Value("tablefunction"));
  EXPECT_EQ(value_of("string.format('%p', {})"),
            Value("`%p` is an address, which differs in each run"));
  EXPECT_EQ(value_of("string.format('%5.2f %d%% %s', 3.14159, 4, 'x')"), Value(" 3.14 4% x"));
  EXPECT_EQ(value_of("('abc'):upper()"), Value("ABC"));
}

TEST(Sandbox, PatternsThatTakeForEverAreRefused) {
  EXPECT_NE(value_of("string.find(string.rep('a', 5000), '.-.-.-b')").text()->find("too long"),
            std::string::npos);
  EXPECT_EQ(value_of("string.match('battery=12', '(%w+)=%d+')"), Value("battery"));
}

TEST(Sandbox, PowerIsFoundOutsideOfTextsAndComments) {
  EXPECT_EQ(value_of("'^' .. \"^\" .. [[^]] .. [==[^]]]==] -- ^"), Value("^^^^]]"));
  EXPECT_NE(value_of("2 ^ 2").text()->find("math.pow"), std::string::npos);
  EXPECT_NE(value_of("'\\'' .. 2^2").text()->find("math.pow"), std::string::npos);
}

}  // namespace
}  // namespace rave::script
