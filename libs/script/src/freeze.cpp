// SPDX-License-Identifier: Apache-2.0
// Makes constant what a file has defined. A constant table is empty, and a metatable leads to its
// contents; scripts cannot set metatables, so each table that has one is constant.
#include <algorithm>
#include <set>
#include <vector>

#include "lua.hpp"
#include "rave/base/names.hpp"

namespace rave::script::lua {
namespace {

constexpr const char* kContents = "contents";
/// In the registry: a list of {function, number of its variable, its value}.
constexpr const char* kWatched = "rave.watched";

int refuse_write(lua_State* state) {
  std::string name = "an entry";
  std::string own = "memory";
  if (lua_type(state, 2) == LUA_TSTRING) {
    name = fmt::format("`{}`", lua_tostring(state, 2));
    own = fmt::format("memory.{}", lua_tostring(state, 2));
  }
  raise(state, fmt::format("{} of a constant table is set: after the file has run only `memory` "
                           "changes; keep it in `{}`",
                           name, own));
}

int length(lua_State* state) {
  push_contents(state, 1);
  lua_pushinteger(state, luaL_len(state, -1));
  return 1;
}

int read_global(lua_State* state) {
  push_contents(state, 1);
  lua_pushvalue(state, 2);
  if (lua_rawget(state, -2) != LUA_TNIL) return 1;
  std::vector<std::string> names;
  for (lua_pushnil(state); lua_next(state, 3) != 0; lua_pop(state, 1)) {
    if (lua_type(state, -2) == LUA_TSTRING) names.emplace_back(lua_tostring(state, -2));
  }
  // next() has an order of its own in each process, and the nearest of two may be any.
  std::ranges::sort(names);
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string name = lua_type(state, 2) == LUA_TSTRING ? lua_tostring(state, 2) : "?";
  const std::string_view near = nearest_name(name, views);
  raise(state, near.empty()
                   ? fmt::format("nothing is called `{}`", name)
                   : fmt::format("nothing is called `{}`; did you mean `{}`?", name, near));
}

class Freezer {
 public:
  explicit Freezer(lua_State* state) : state_(state) {}

  /// What is on top of the stack; it stays there.
  void value() {
    luaL_checkstack(state_, 8, "constants");
    if (lua_type(state_, -1) == LUA_TTABLE) {
      table();
    } else if (lua_type(state_, -1) == LUA_TFUNCTION) {
      function();
    }
  }
  /// The table of globals itself.
  void globals() {
    seen_.insert(lua_topointer(state_, -1));
    values("memory");
    seal(read_global);
  }

 private:
  bool is_new() { return seen_.insert(lua_topointer(state_, -1)).second; }

  void table() {
    if (!is_new()) return;
    if (lua_getmetatable(state_, -1) != 0) {
      lua_pop(state_, 1);  // It is constant already.
      return;
    }
    values(nullptr);
    seal(nullptr);
  }

  void values(const char* except) {
    for (lua_pushnil(state_); lua_next(state_, -2) != 0; lua_pop(state_, 1)) {
      const bool skip = except != nullptr && lua_type(state_, -2) == LUA_TSTRING &&
                        std::string_view(lua_tostring(state_, -2)) == except;
      if (!skip) value();
    }
  }

  /// Moves the entries of the table on top of the stack into another one, behind a metatable.
  void seal(lua_CFunction read) {
    lua_newtable(state_);  // table, contents
    for (lua_pushnil(state_); lua_next(state_, -3) != 0;) {
      lua_pushvalue(state_, -2);
      lua_insert(state_, -2);  // table, contents, key, key, value
      lua_rawset(state_, -4);
    }
    for (lua_pushnil(state_); lua_next(state_, -2) != 0; lua_pop(state_, 1)) {
      lua_pushvalue(state_, -2);
      lua_pushnil(state_);
      lua_rawset(state_, -6);
    }
    lua_createtable(state_, 0, 4);  // table, contents, metatable
    lua_pushvalue(state_, -2);
    lua_setfield(state_, -2, kContents);
    if (read != nullptr) {
      lua_pushcfunction(state_, read);
    } else {
      lua_pushvalue(state_, -2);
    }
    lua_setfield(state_, -2, "__index");
    lua_pushcfunction(state_, refuse_write);
    lua_setfield(state_, -2, "__newindex");
    lua_pushcfunction(state_, length);
    lua_setfield(state_, -2, "__len");
    lua_setmetatable(state_, -3);
    lua_pop(state_, 1);
  }

  void function() {
    if (!is_new()) return;
    for (int i = 1;; ++i) {
      const char* const name = lua_getupvalue(state_, -1, i);
      if (name == nullptr) return;
      // Functions of C have variables without names, which are not the script's.
      const bool own = *name != '\0' && std::string_view(name) != "_ENV";
      if (own) {
        watch(i);
        value();
      }
      lua_pop(state_, 1);
    }
  }

  /// Notes the variable `i` of the function below the top, whose value is on top.
  void watch(int i) {
    lua_getfield(state_, LUA_REGISTRYINDEX, kWatched);
    lua_createtable(state_, 3, 0);
    lua_pushvalue(state_, -4);
    lua_rawseti(state_, -2, 1);
    lua_pushinteger(state_, i);
    lua_rawseti(state_, -2, 2);
    lua_pushvalue(state_, -3);
    lua_rawseti(state_, -2, 3);
    lua_rawseti(state_, -2, luaL_len(state_, -2) + 1);
    lua_pop(state_, 1);
  }

  lua_State* state_;
  std::set<const void*> seen_;
};

}  // namespace

bool push_contents(lua_State* state, int index) {
  if (lua_type(state, index) != LUA_TTABLE || lua_getmetatable(state, index) == 0) return false;
  lua_getfield(state, -1, kContents);
  lua_remove(state, -2);
  return true;
}

void freeze(lua_State* state) {
  lua_newtable(state);
  lua_setfield(state, LUA_REGISTRYINDEX, kWatched);
  Freezer(state).globals();
}

void check_frozen(lua_State* state) {
  const int top = lua_gettop(state);
  lua_getfield(state, LUA_REGISTRYINDEX, kWatched);
  const int list = lua_gettop(state);
  const lua_Integer count = luaL_len(state, list);
  std::string changed;
  for (lua_Integer i = 1; i <= count; ++i) {
    lua_settop(state, list);
    lua_rawgeti(state, list, i);
    lua_rawgeti(state, -1, 2);
    const int number = static_cast<int>(lua_tointeger(state, -1));
    lua_rawgeti(state, -2, 3);
    lua_rawgeti(state, -3, 1);
    const char* const name = lua_getupvalue(state, -1, number);
    if (lua_rawequal(state, -1, -3) != 0) continue;
    if (changed.empty()) changed = name;
    lua_pop(state, 1);
    lua_pushvalue(state, -2);
    lua_setupvalue(state, -2, number);
  }
  lua_settop(state, top);
  if (changed.empty()) return;
  raise(state,
        fmt::format("`{}` was changed after the file has run: keep what changes in `memory`, "
                    "such as `memory.{}`",
                    changed, changed));
}

}  // namespace rave::script::lua
