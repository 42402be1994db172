// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <lua.hpp>
#include <string>
#include <string_view>

#include "rave/script/script.hpp"
#include "rave/script/value.hpp"

// What the sources of this library share. Debian's liblua5.4-c++ raises errors as exceptions, so
// objects of C++ are destroyed on the way out of a function that Lua calls.
namespace rave::script::lua {

/// What a state uses, and may use.
struct Budget {
  Limits limits;
  std::size_t bytes = 0;
  std::uint64_t instructions = 0;  ///< Of the present call.
};

/// Raises an error of the script, at the line that runs at this level of calls: 1 is who called the
/// function that raises it.
[[noreturn]] void raise(lua_State* state, const std::string& text, int level = 1);

/// A new state that allocates and computes within the budget, which must outlive it.
[[nodiscard]] lua_State* new_state(Budget& budget);
/// Begins a call: its instructions count from here.
void begin_call(lua_State* state, Budget& budget);

/// Fills the table of globals, on top of the stack, with what scripts may use.
void open_sandbox(lua_State* state);

/// Makes all tables and variables constant that the table on top of the stack leads to, itself
/// included, except for `memory`, and leaves the constant table there. Reading an unknown global is
/// an error afterwards.
void freeze(lua_State* state);
/// Raises an error if a variable of a function changed since freeze(), and sets it back.
void check_frozen(lua_State* state);
/// The contents of a constant table, pushed; false, and nothing pushed, for other tables.
bool push_contents(lua_State* state, int index);

/// The value at the index. Raises an error if it is not plain.
[[nodiscard]] Value to_value(lua_State* state, int index, std::string_view what);
void push(lua_State* state, const Value& value);

/// The place of the first power operator in a source, as line and column; 0: there is none.
struct Place {
  int line = 0;
  int column = 0;
};
[[nodiscard]] Place find_power(std::string_view source);

}  // namespace rave::script::lua
