// SPDX-License-Identifier: Apache-2.0
// Values from and to the stack.
#include <algorithm>

#include "lua.hpp"

namespace rave::script::lua {
namespace {

std::string label(std::string_view what, const Value::Key& key) {
  if (const auto* const whole = std::get_if<std::int64_t>(&key)) {
    return fmt::format("{}[{}]", what, *whole);
  }
  return fmt::format("{}.{}", what, std::get<std::string>(key));
}

Value::Key key_at(lua_State* state, int index, std::string_view what) {
  if (lua_isinteger(state, index) != 0) return lua_tointeger(state, index);
  if (lua_type(state, index) == LUA_TSTRING) {
    std::size_t size = 0;
    const char* const text = lua_tolstring(state, index, &size);
    return std::string(text, size);
  }
  raise(state, fmt::format("a key of `{}` is {}; expected whole numbers and texts", what,
                           luaL_typename(state, index)));
}

Value value_at(lua_State* state, int index, const std::string& what, int depth);

Value table_at(lua_State* state, int index, const std::string& what, int depth) {
  if (depth >= kMaxValueDepth) {
    raise(state, fmt::format("`{}` is nested deeper than {}; does it contain itself?", what,
                             kMaxValueDepth));
  }
  luaL_checkstack(state, 4, "a value");
  const int top = lua_gettop(state);
  if (push_contents(state, index)) index = lua_gettop(state);
  Value::Table table;
  for (lua_pushnil(state); lua_next(state, index) != 0; lua_pop(state, 1)) {
    Value::Key key = key_at(state, -2, what);
    const std::string name = label(what, key);
    table.push_back({std::move(key), value_at(state, lua_gettop(state), name, depth + 1)});
  }
  lua_settop(state, top);
  std::ranges::sort(table, {}, &Value::Entry::key);
  return table;
}

Value value_at(lua_State* state, int index, const std::string& what, int depth) {
  switch (lua_type(state, index)) {
    case LUA_TNONE:
    case LUA_TNIL:
      return {};
    case LUA_TBOOLEAN:
      return lua_toboolean(state, index) != 0;
    case LUA_TNUMBER:
      if (lua_isinteger(state, index) != 0) return std::int64_t{lua_tointeger(state, index)};
      return lua_tonumber(state, index);
    case LUA_TSTRING: {
      std::size_t size = 0;
      const char* const text = lua_tolstring(state, index, &size);
      return std::string(text, size);
    }
    case LUA_TTABLE:
      return table_at(state, index, what, depth);
    default:
      raise(state, fmt::format("`{}` is a {}; expected a number, a text, true or false, or a table "
                               "of these",
                               what, luaL_typename(state, index)));
  }
}

}  // namespace

Value to_value(lua_State* state, int index, std::string_view what) {
  return value_at(state, lua_absindex(state, index), std::string(what), 0);
}

void push(lua_State* state, const Value& value) {
  luaL_checkstack(state, 4, "a value");
  if (const auto* const truth = std::get_if<bool>(&value.is)) {
    lua_pushboolean(state, *truth ? 1 : 0);
  } else if (const auto* const whole = std::get_if<std::int64_t>(&value.is)) {
    lua_pushinteger(state, *whole);
  } else if (const auto* const real = std::get_if<double>(&value.is)) {
    lua_pushnumber(state, *real);
  } else if (const std::string* const text = value.text()) {
    lua_pushlstring(state, text->data(), text->size());
  } else if (const Value::Table* const table = value.table()) {
    lua_createtable(state, 0, 0);
    for (const auto& [key, entry] : *table) {
      if (const auto* const number = std::get_if<std::int64_t>(&key)) {
        push(state, entry);
        lua_rawseti(state, -2, *number);
        continue;
      }
      const auto& name = std::get<std::string>(key);
      lua_pushlstring(state, name.data(), name.size());
      push(state, entry);
      lua_rawset(state, -3);
    }
  } else {
    lua_pushnil(state);
  }
}

}  // namespace rave::script::lua
