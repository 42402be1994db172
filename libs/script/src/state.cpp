// SPDX-License-Identifier: Apache-2.0
// Memory and instructions of a state.
#include <cstdlib>

#include "lua.hpp"

namespace rave::script::lua {
namespace {

constexpr int kCountEach = 1000;

void* allocate(void* context, void* block, std::size_t old_size, std::size_t size) {
  auto& budget = *static_cast<Budget*>(context);
  // For a new block, Lua says what it is for instead of a size.
  const std::size_t old_bytes = block != nullptr ? old_size : 0;
  if (size == 0) {
    std::free(block);
    budget.bytes -= old_bytes;
    return nullptr;
  }
  if (size > old_bytes && budget.bytes + (size - old_bytes) > budget.limits.bytes) return nullptr;
  void* const moved = std::realloc(block, size);
  if (moved != nullptr) budget.bytes += size - old_bytes;
  return moved;
}

Budget& budget_of(lua_State* state) {
  void* context = nullptr;
  lua_getallocf(state, &context);
  return *static_cast<Budget*>(context);
}

void count(lua_State* state, lua_Debug* /*where*/) {
  Budget& budget = budget_of(state);
  budget.instructions += kCountEach;
  if (budget.instructions <= budget.limits.instructions) return;
  raise(state,
        fmt::format("more than {} instructions in one call; does it loop for ever?",
                    budget.limits.instructions),
        0);
}

}  // namespace

void raise(lua_State* state, const std::string& text, int level) {
  luaL_where(state, level);
  lua_pushlstring(state, text.data(), text.size());
  lua_concat(state, 2);
  lua_error(state);
  std::abort();  // lua_error() does not return, which its declaration does not say.
}

lua_State* new_state(Budget& budget) { return lua_newstate(allocate, &budget); }

void begin_call(lua_State* state, Budget& budget) {
  budget.instructions = 0;
  lua_sethook(state, count, LUA_MASKCOUNT, kCountEach);
}

}  // namespace rave::script::lua
