// SPDX-License-Identifier: Apache-2.0
// What scripts may use of Lua's libraries, and what takes the place of the rest so that results are
// the same on every machine.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lua.hpp"
#include "rave/math/exponential.hpp"
#include "rave/math/scalar.hpp"
#include "rave/math/trigonometry.hpp"

namespace rave::script::lua {
namespace {

/// Copies functions of a library into a new table on top of the stack.
template <std::size_t kNames>
void copy_library(lua_State* state, lua_CFunction open, const char* name,
                  const std::array<const char*, kNames>& names) {
  luaL_requiref(state, name, open, 0);
  lua_createtable(state, 0, static_cast<int>(kNames));
  for (const char* const function : names) {
    lua_getfield(state, -2, function);
    lua_setfield(state, -2, function);
  }
  lua_remove(state, -2);
}

void set_function(lua_State* state, const char* name, lua_CFunction function) {
  lua_pushcfunction(state, function);
  lua_setfield(state, -2, name);
}

// Keys are collected and sorted: Lua's own order depends on a seed that differs in each process.

int next_sorted(lua_State* state) {
  // Upvalues: the list of keys, the place in it.
  const lua_Integer place = lua_tointeger(state, lua_upvalueindex(2)) + 1;
  lua_pushinteger(state, place);
  lua_replace(state, lua_upvalueindex(2));
  if (lua_rawgeti(state, lua_upvalueindex(1), place) == LUA_TNIL) return 1;
  lua_pushvalue(state, -1);
  lua_gettable(state, 1);
  return 2;
}

int pairs(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  lua_settop(state, 1);
  if (!push_contents(state, 1)) lua_pushvalue(state, 1);
  std::vector<Value::Key> keys;
  for (lua_pushnil(state); lua_next(state, 2) != 0; lua_pop(state, 1)) {
    if (lua_isinteger(state, -2) != 0) {
      keys.emplace_back(lua_tointeger(state, -2));
    } else if (lua_type(state, -2) == LUA_TSTRING) {
      std::size_t size = 0;
      const char* const text = lua_tolstring(state, -2, &size);
      keys.emplace_back(std::string(text, size));
    } else {
      raise(state, fmt::format("`pairs` over a key that is a {}: only whole numbers and texts have "
                               "an order",
                               luaL_typename(state, -2)));
    }
  }
  std::ranges::sort(keys);
  lua_createtable(state, static_cast<int>(keys.size()), 0);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    std::visit([state](const auto& key) { push(state, Value(key)); }, keys[i]);
    lua_rawseti(state, -2, static_cast<lua_Integer>(i + 1));
  }
  lua_pushinteger(state, 0);
  lua_pushcclosure(state, next_sorted, 2);
  lua_pushvalue(state, 1);
  lua_pushnil(state);
  return 3;
}

/// Texts of tables and functions would be their addresses.
int to_string(lua_State* state) {
  luaL_checkany(state, 1);
  switch (lua_type(state, 1)) {
    case LUA_TNUMBER:
    case LUA_TSTRING:
    case LUA_TBOOLEAN:
    case LUA_TNIL:
      luaL_tolstring(state, 1, nullptr);
      return 1;
    default:
      lua_pushstring(state, luaL_typename(state, 1));
      return 1;
  }
}

int format(lua_State* state) {
  std::size_t size = 0;
  const char* const pattern = luaL_checklstring(state, 1, &size);
  for (std::size_t i = 0; i + 1 < size; ++i) {
    if (pattern[i] != '%') continue;
    ++i;
    while (i + 1 < size &&
           std::string_view("-+ #0123456789.").find(pattern[i]) != std::string_view::npos)
      ++i;
    if (pattern[i] == 'p') raise(state, "`%p` is an address, which differs in each run");
  }
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  lua_call(state, lua_gettop(state) - 1, 1);
  return 1;
}

/// Refuses patterns that could take for ever: matching runs outside of Lua's machine, so its
/// instructions are not counted.
int match(lua_State* state) {
  std::size_t text_size = 0;
  std::size_t pattern_size = 0;
  luaL_checklstring(state, 1, &text_size);
  const char* const pattern = luaL_checklstring(state, 2, &pattern_size);
  double cost = 1;
  constexpr double kMostCost = 1e7;
  for (const char c : std::string_view(pattern, pattern_size)) {
    const bool repeats = c == '*' || c == '+' || c == '-' || c == '?';
    if (repeats) cost *= static_cast<double>(text_size + 1);
  }
  if (cost * static_cast<double>(text_size + 1) > kMostCost) {
    raise(state, "this pattern can take too long on a text of this length");
  }
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  lua_call(state, lua_gettop(state) - 1, LUA_MULTRET);
  return lua_gettop(state);
}

/// Puts a function before a function of the table on top of the stack.
void guard(lua_State* state, const char* name, lua_CFunction function) {
  lua_getfield(state, -1, name);
  lua_pushcclosure(state, function, 1);
  lua_setfield(state, -2, name);
}

// Lua's own sort takes the time of day into account, which shows where elements are equal.

bool comes_before(lua_State* state, int list_a, lua_Integer a, int list_b, lua_Integer b) {
  lua_geti(state, list_a, a);
  lua_geti(state, list_b, b);
  if (lua_isnoneornil(state, 2)) {
    const bool less = lua_compare(state, -2, -1, LUA_OPLT) != 0;
    lua_pop(state, 2);
    return less;
  }
  lua_pushvalue(state, 2);
  lua_insert(state, -3);
  lua_call(state, 2, 1);
  const bool less = lua_toboolean(state, -1) != 0;
  lua_pop(state, 1);
  return less;
}

/// Merges two sorted runs of `from`, [low, middle) and [middle, high), into `to`.
void merge(lua_State* state, int from, int to, lua_Integer low, lua_Integer middle,
           lua_Integer high) {
  lua_Integer left = low;
  lua_Integer right = middle;
  for (lua_Integer out = low; out < high; ++out) {
    // Of equal ones the left comes first, so the sort is stable.
    const bool take_right =
        left == middle || (right < high && comes_before(state, from, right, from, left));
    lua_geti(state, from, take_right ? right++ : left++);
    lua_seti(state, to, out);
  }
}

int sort(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  const lua_Integer count = luaL_len(state, 1);
  lua_settop(state, 2);
  if (!lua_isnil(state, 2)) luaL_checktype(state, 2, LUA_TFUNCTION);
  if (push_contents(state, 1)) raise(state, "this table is constant; sort a copy in `memory`");
  lua_createtable(state, static_cast<int>(std::min<lua_Integer>(count, 1 << 20)), 0);
  int from = 1;
  int to = 3;
  for (lua_Integer width = 1; width < count; width *= 2) {
    for (lua_Integer low = 1; low <= count; low += 2 * width) {
      merge(state, from, to, low, std::min(low + width, count + 1),
            std::min(low + 2 * width, count + 1));
    }
    std::swap(from, to);
  }
  if (from == 1) return 0;
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_geti(state, from, i);
    lua_seti(state, 1, i);
  }
  return 0;
}

template <double (*kFunction)(double)>
int of_one(lua_State* state) {
  lua_pushnumber(state, kFunction(luaL_checknumber(state, 1)));
  return 1;
}

/// One argument is an ordinate over 1, as in Lua.
int arc_tangent(lua_State* state) {
  lua_pushnumber(state, rave::atan2(luaL_checknumber(state, 1), luaL_optnumber(state, 2, 1)));
  return 1;
}
int logarithm(lua_State* state) {
  const double value = rave::log(luaL_checknumber(state, 1));
  lua_pushnumber(state,
                 lua_isnoneornil(state, 2) ? value : value / rave::log(luaL_checknumber(state, 2)));
  return 1;
}
int hypotenuse(lua_State* state) {
  lua_pushnumber(state, rave::hypot(luaL_checknumber(state, 1), luaL_checknumber(state, 2)));
  return 1;
}
/// Exact for whole exponents up to 64; otherwise by exp and log, within some 1e-13 of the value.
int power(lua_State* state) {
  const double base = luaL_checknumber(state, 1);
  const double exponent = luaL_checknumber(state, 2);
  constexpr double kMostFactors = 64;
  if (std::abs(exponent) <= kMostFactors && exponent == std::floor(exponent)) {
    double product = 1;
    for (int i = 0; i < static_cast<int>(std::abs(exponent)); ++i) product *= base;
    lua_pushnumber(state, exponent < 0 ? 1 / product : product);
    return 1;
  }
  lua_pushnumber(state, exponent == 0.5 ? std::sqrt(base) : rave::exp(exponent * rave::log(base)));
  return 1;
}

double sine(double x) { return rave::sin(x); }
double cosine(double x) { return rave::cos(x); }
double tangent(double x) { return rave::tan(x); }
double arc_sine(double x) { return rave::asin(x); }
double arc_cosine(double x) { return rave::acos(x); }
double exponential(double x) { return rave::exp(x); }

void open_math(lua_State* state) {
  static constexpr std::array kExact = {"abs",  "ceil", "floor",     "fmod",       "huge",
                                        "max",  "min",  "modf",      "pi",         "sqrt",
                                        "type", "ult",  "tointeger", "maxinteger", "mininteger"};
  copy_library(state, luaopen_math, LUA_MATHLIBNAME, kExact);
  set_function(state, "sin", of_one<sine>);
  set_function(state, "cos", of_one<cosine>);
  set_function(state, "tan", of_one<tangent>);
  set_function(state, "asin", of_one<arc_sine>);
  set_function(state, "acos", of_one<arc_cosine>);
  set_function(state, "exp", of_one<exponential>);
  set_function(state, "atan", arc_tangent);
  set_function(state, "log", logarithm);
  set_function(state, "hypot", hypotenuse);
  set_function(state, "pow", power);
}

}  // namespace

void open_sandbox(lua_State* state) {
  static constexpr std::array kBase = {"assert", "error",    "ipairs",   "select",
                                       "type",   "tonumber", "rawequal", "rawlen"};
  static constexpr std::array kTable = {"concat", "insert", "move", "pack", "remove", "unpack"};
  static constexpr std::array kString = {"byte",    "char", "find",  "format", "gmatch",
                                         "gsub",    "len",  "lower", "match",  "rep",
                                         "reverse", "sub",  "upper"};
  copy_library(state, luaopen_base, LUA_GNAME, kBase);
  for (const char* const name : kBase) {
    lua_getfield(state, -1, name);
    lua_setfield(state, -3, name);
  }
  lua_pop(state, 1);
  set_function(state, "pairs", pairs);
  set_function(state, "tostring", to_string);
  open_math(state);
  lua_setfield(state, -2, "math");
  copy_library(state, luaopen_table, LUA_TABLIBNAME, kTable);
  set_function(state, "sort", sort);
  lua_setfield(state, -2, "table");
  copy_library(state, luaopen_string, LUA_STRLIBNAME, kString);
  guard(state, "format", format);
  for (const char* const name : {"find", "match", "gmatch", "gsub"}) guard(state, name, match);
  // `text:upper()` goes by the metatable of texts.
  lua_pushliteral(state, "");
  lua_getmetatable(state, -1);
  lua_pushvalue(state, -3);
  lua_setfield(state, -2, "__index");
  lua_pop(state, 2);
  lua_setfield(state, -2, "string");
}

}  // namespace rave::script::lua
