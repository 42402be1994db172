// SPDX-License-Identifier: Apache-2.0
#include "rave/script/script.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace rave::script {
namespace {

Result<Value> add(std::span<const Value> arguments) {
  if (arguments.size() != 2) return fail(ErrorCode::kInvalidArgument, "expected two numbers");
  return Value(arguments[0].number_or(0) + arguments[1].number_or(0));
}

std::unique_ptr<Script> loaded(std::string_view source, const Limits& limits = {}) {
  auto script = Script::load(
      source, "mission.lua",
      {{"add", add}, {"math.twice", [](auto its) { return Value(2 * its[0].number_or(0)); }}},
      limits);
  EXPECT_TRUE(script.has_value()) << script.error().text();
  return script ? *std::move(script) : nullptr;
}

std::string load_error(std::string_view source) {
  const auto script = Script::load(source, "mission.lua", {{"add", add}});
  return script ? "loaded" : script.error().text();
}

std::string call_error(Script& script, std::string_view function) {
  const auto value = script.call(function, {});
  return value ? "done" : value.error().text();
}

TEST(Script, CallsAndIsCalled) {
  const auto script = loaded("function sum(a, b) return add(a, b) + math.twice(1) end");
  const std::vector<Value> arguments = {Value(1.5), Value(std::int64_t{2})};
  EXPECT_EQ(*script->call("sum", arguments), Value(5.5));
  EXPECT_TRUE(script->defines("sum"));
  EXPECT_FALSE(script->defines("sums"));
  EXPECT_FALSE(script->defines("memory"));
}

TEST(Script, ExpressionsSeeTheFile) {
  const auto script = loaded("LIMIT = 3  function far(x) return x > LIMIT end");
  const auto expression = script->compile("far(add(1, 1)) or far(4)", {"scenario.yaml", 12, 9});
  ASSERT_TRUE(expression.has_value());
  EXPECT_EQ(*script->evaluate(*expression), Value(true));
}

TEST(Script, ErrorsHaveTheirPlace) {
  EXPECT_EQ(load_error("x = 1\ny = = 2"), "mission.lua:2: unexpected symbol near '='");
  EXPECT_EQ(load_error("x = 2\ny = x ^ 3"),
            "mission.lua:2:7: the operator `^` differs from processor to processor; expected "
            "`math.pow(x, y)`, or `x * x`");
  const auto script = loaded("function f()\n  return 1 + {}\nend\nfunction g()\n add(1)\nend");
  EXPECT_EQ(call_error(*script, "f"),
            "mission.lua:2: attempt to perform arithmetic on a table value");
  EXPECT_EQ(call_error(*script, "g"), "mission.lua:5: expected two numbers");
  EXPECT_EQ(call_error(*script, "h"), "mission.lua defines no function `h`");
  const auto bad = script->compile("1 +", {"scenario.yaml", 12, 9});
  ASSERT_FALSE(bad.has_value());
  EXPECT_EQ(bad.error().where.text(), "scenario.yaml:12:9");
  EXPECT_EQ(bad.error().code, ErrorCode::kParse);
  const auto wrong = script->compile("ad(1, 2)", {"scenario.yaml", 13, 1});
  ASSERT_TRUE(wrong.has_value());
  EXPECT_EQ(script->evaluate(*wrong).error().text(),
            "scenario.yaml:13:1: nothing is called `ad`; did you mean `add`?");
}

TEST(Script, ConcludesWhatLoopsForEver) {
  const auto script = loaded("function f() while true do end end  function g() return 1 end",
                             {.instructions = 50'000});
  EXPECT_EQ(call_error(*script, "f"),
            "mission.lua:1: more than 50000 instructions in one call; does it loop for ever?");
  EXPECT_EQ(call_error(*script, "g"), "done");
  EXPECT_NE(load_error("while true do end").find("more than"), std::string::npos);
  EXPECT_NE(load_error("function f() return f() + 1 end f()"), "loaded");
}

TEST(Script, ConcludesWhatEatsMemory) {
  const auto script = loaded(
      "function f() local t = {} for i = 1, 1e9 do t[i] = i end end\n"
      "function g() return string.rep('x', 1 << 40) end\n"
      "function h() return 1 end",
      {.instructions = 100'000'000, .bytes = 1 << 20});
  EXPECT_EQ(call_error(*script, "f"), "mission.lua: the script needs more than 1048576 bytes");
  EXPECT_NE(call_error(*script, "g"), "done");
  EXPECT_EQ(call_error(*script, "h"), "done");
}

TEST(Script, OnlyMemoryChanges) {
  const auto script = loaded(
      "count = 0  local n = 0  route = {1, 2}  local list = {a = {}}\n"
      "function global() count = count + 1 end\n"
      "function variable() n = n + 1 return n end\n"
      "function entry() route[1] = 5 end\n"
      "function deep() list.a.b = 1 end\n"
      "function replace() memory = 1 end\n"
      "function insert() table.insert(route, 3) end\n"
      "function read() return #route + route[2] + n end\n"
      "function count_up() memory.n = (memory.n or 0) + 1 return memory.n end");
  for (const char* const function : {"global", "variable", "entry", "deep", "replace", "insert"}) {
    EXPECT_NE(call_error(*script, function).find("memory"), std::string::npos) << function;
  }
  EXPECT_EQ(*script->call("read", {}), Value(std::int64_t{4}));
  EXPECT_EQ(*script->call("count_up", {}), Value(std::int64_t{1}));
  EXPECT_EQ(*script->call("count_up", {}), Value(std::int64_t{2}));
  EXPECT_EQ(*script->memory().find("n"), Value(std::int64_t{2}));
}

TEST(Script, AnotherProcessContinuesFromItsMemory) {
  constexpr std::string_view kSource =
      "memory.seen = {}\n"
      "function on_step(t)\n"
      "  memory.seen[#memory.seen + 1] = t\n"
      "  if #memory.seen > 3 then table.remove(memory.seen, 1) end\n"
      "  memory.sum = (memory.sum or 0) + memory.seen[1]\n"
      "  return memory.sum\n"
      "end";
  const auto first = loaded(kSource);
  const auto step = [](Script& script, double t) {
    const Value argument(t);
    return *script.call("on_step", std::span(&argument, 1));
  };
  for (int i = 0; i < 5; ++i) step(*first, 0.1 * i);
  const auto second = loaded(kSource);
  const auto carried = read_value(write_value(first->memory()));
  ASSERT_TRUE(carried.has_value());
  ASSERT_TRUE(second->set_memory(*carried).has_value());
  for (int i = 5; i < 9; ++i) EXPECT_EQ(step(*first, 0.1 * i), step(*second, 0.1 * i));
  EXPECT_EQ(first->memory(), second->memory());
}

TEST(Script, MemoryOfAFailedCallDoesNotCount) {
  const auto script = loaded("function f(x) memory.x = x  if x > 1 then error('no') end end");
  Value argument(1.0);
  EXPECT_TRUE(script->call("f", std::span(&argument, 1)).has_value());
  argument = Value(2.0);
  EXPECT_FALSE(script->call("f", std::span(&argument, 1)).has_value());
  EXPECT_EQ(*script->memory().find("x"), Value(1.0));
}

TEST(Script, MemoryHoldsPlainValues) {
  const auto script = loaded(
      "function f() memory.f = f end\n"
      "function g() memory.g = {{}} memory.g[1][1] = memory end\n"
      "function h() memory[1.5] = 1 end\n"
      "function k() memory.k = string.rep('x', 70000) end");
  EXPECT_EQ(call_error(*script, "f"),
            "mission.lua: `memory.f` is a function; expected a number, a text, true or false, or a "
            "table of these");
  EXPECT_NE(call_error(*script, "g").find("nested deeper than 16"), std::string::npos);
  EXPECT_NE(call_error(*script, "h").find("expected whole numbers and texts"), std::string::npos);
  EXPECT_NE(call_error(*script, "k").find("expected at most 65536"), std::string::npos);
}

}  // namespace
}  // namespace rave::script
