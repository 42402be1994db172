// SPDX-License-Identifier: Apache-2.0
#include "rave/script/script.hpp"

#include <algorithm>
#include <utility>

#include "lua.hpp"
#include "rave/base/number.hpp"

namespace rave::script {
namespace {

constexpr const char* kGlobals = "rave.globals";

/// Calls `work` where errors of Lua become the result: true, or false with the error on the stack.
template <class Work>
bool protect(lua_State* state, Work&& work) {
  lua_pushcfunction(state, [](lua_State* inner) {
    auto& its = *static_cast<std::remove_reference_t<Work>*>(lua_touserdata(inner, 1));
    lua_settop(inner, 0);
    its();
    return 0;
  });
  lua_pushlightuserdata(state, &work);
  return lua_pcall(state, 1, 0, 0) == LUA_OK;
}

/// Splits `FILE:LINE: message`.
Error located(std::string text, std::string_view file, ErrorCode code) {
  Error error{code, std::move(text), {std::string(file), 0, 0}};
  if (!error.message.starts_with(fmt::format("{}:", file))) return error;
  const std::size_t begin = file.size() + 1;
  const std::size_t end = error.message.find(": ", begin);
  if (end == std::string::npos) return error;
  const auto line = number_of<int>(std::string_view(error.message).substr(begin, end - begin));
  if (!line) return error;
  error.where.line = *line;
  error.message.erase(0, end + 2);
  return error;
}

}  // namespace

struct Script::Impl {
  lua::Budget budget{};
  std::string file{};
  std::vector<Provided> provided{};
  lua_State* state = nullptr;
  std::vector<SourceLocation> expressions{};  ///< Their places; the functions are in the registry.
  Value memory = Value::Table{};

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (state != nullptr) lua_close(state);
  }

  [[nodiscard]] Status run_file(std::string_view source);
  void prepare(std::string_view source);
  void provide(const Provided& one);
  [[nodiscard]] tl::unexpected<Error> failed(ErrorCode code = ErrorCode::kPlugin);
  /// Calls the function that `push_function` pushes, with the arguments; its memory counts only if
  /// all goes well.
  template <class Push>
  Result<Value> call(Push&& push_function, std::span<const Value> arguments);
  void push_memory() const;
  void set_memory_there();
  [[nodiscard]] Value new_memory() const;
};

namespace {

int call_provided(lua_State* state) {
  const auto& function = *static_cast<const Function*>(lua_touserdata(state, lua_upvalueindex(1)));
  std::vector<Value> arguments;
  for (int i = 1; i <= lua_gettop(state); ++i) {
    arguments.push_back(lua::to_value(state, i, fmt::format("argument {}", i)));
  }
  const Result<Value> result = function(arguments);
  if (!result) lua::raise(state, result.error().message);
  lua::push(state, *result);
  return 1;
}

std::string key_of(std::size_t expression) { return fmt::format("rave.expression.{}", expression); }

/// Compiles a text with the globals as its only variables, and pushes it.
void compile_text(lua_State* state, std::string_view source, const std::string& name) {
  const std::string chunk = "@" + name;
  // Text only: compiled code could do anything.
  if (luaL_loadbufferx(state, source.data(), source.size(), chunk.c_str(), "t") != LUA_OK) {
    lua_error(state);
  }
  lua_getfield(state, LUA_REGISTRYINDEX, kGlobals);
  lua_setupvalue(state, -2, 1);
}

Status check_power(std::string_view source, const SourceLocation& begin) {
  const lua::Place place = lua::find_power(source);
  if (place.line == 0) return {};
  SourceLocation where = begin;
  where.line += place.line - 1;
  where.column =
      place.line == 1 && begin.column > 0 ? begin.column + place.column - 1 : place.column;
  return fail_at(where, ErrorCode::kParse,
                 "the operator `^` differs from processor to processor; expected "
                 "`math.pow(x, y)`, or `x * x`");
}

}  // namespace

tl::unexpected<Error> Script::Impl::failed(ErrorCode code) {
  std::size_t size = 0;
  const char* const text = lua_tolstring(state, -1, &size);
  std::string message = text != nullptr ? std::string(text, size) : "an error that is no text";
  lua_settop(state, 0);
  // Lua's own words name neither the limit nor what to do.
  if (message.ends_with("not enough memory")) {
    message = fmt::format("the script needs more than {} bytes", budget.limits.bytes);
  }
  return tl::unexpected(located(std::move(message), file, code));
}

void Script::Impl::provide(const Provided& one) {
  const std::size_t dot = one.name.find('.');
  const std::string name = one.name.substr(dot == std::string::npos ? 0 : dot + 1);
  lua_getfield(state, LUA_REGISTRYINDEX, kGlobals);
  if (dot != std::string::npos) {
    const std::string table = one.name.substr(0, dot);
    if (lua_getfield(state, -1, table.c_str()) != LUA_TTABLE) {
      lua_pop(state, 1);
      lua_newtable(state);
      lua_pushvalue(state, -1);
      lua_setfield(state, -3, table.c_str());
    }
  }
  // The list of functions does not change while the state lives.
  lua_pushlightuserdata(state, const_cast<Function*>(&one.function));  // NOLINT(*-const-cast)
  lua_pushcclosure(state, call_provided, 1);
  lua_setfield(state, -2, name.c_str());
  lua_settop(state, 0);
}

void Script::Impl::prepare(std::string_view source) {
  lua_newtable(state);
  lua_pushvalue(state, -1);
  lua_setfield(state, LUA_REGISTRYINDEX, kGlobals);
  lua::open_sandbox(state);
  lua_newtable(state);
  lua_setfield(state, -2, "memory");
  lua_settop(state, 0);
  for (const Provided& one : provided) provide(one);
  compile_text(state, source, file);
  lua_call(state, 0, 0);
  lua_getfield(state, LUA_REGISTRYINDEX, kGlobals);
  lua::freeze(state);
}

Status Script::Impl::run_file(std::string_view source) {
  RAVE_TRY(check_power(source, {file, 1, 1}));
  lua::begin_call(state, budget);
  Value memory_then;
  const bool good = protect(state, [&] {
    prepare(source);
    memory_then = new_memory();
  });
  if (!good) return failed();
  memory = std::move(memory_then);
  return {};
}

Value Script::Impl::new_memory() const {
  push_memory();
  Value value = lua::to_value(state, -1, "memory");
  lua_pop(state, 1);
  if (value.table() == nullptr) lua::raise(state, "`memory` must stay a table");
  const std::size_t size = write_value(value).size();
  if (size > budget.limits.memory_bytes) {
    lua::raise(state, fmt::format("`memory` has {} bytes; expected at most {}", size,
                                  budget.limits.memory_bytes));
  }
  return value;
}

/// The variable is among the contents of the constant globals.
void Script::Impl::push_memory() const {
  lua_getfield(state, LUA_REGISTRYINDEX, kGlobals);
  if (lua::push_contents(state, -1)) lua_remove(state, -2);
  lua_getfield(state, -1, "memory");
  lua_remove(state, -2);
}

/// Built anew each time, so that it is in the same form here and in a process that continues.
void Script::Impl::set_memory_there() {
  lua_getfield(state, LUA_REGISTRYINDEX, kGlobals);
  if (lua::push_contents(state, -1)) lua_remove(state, -2);
  lua::push(state, memory);
  lua_setfield(state, -2, "memory");
  lua_pop(state, 1);
}

template <class Push>
Result<Value> Script::Impl::call(Push&& push_function, std::span<const Value> arguments) {
  lua::begin_call(state, budget);
  Value result;
  Value memory_then;
  const bool good = protect(state, [&] {
    set_memory_there();
    push_function();
    for (const Value& argument : arguments) lua::push(state, argument);
    lua_call(state, static_cast<int>(arguments.size()), 1);
    result = lua::to_value(state, -1, "the result");
    lua::check_frozen(state);
    memory_then = new_memory();
  });
  if (!good) {
    auto error = failed();
    // What an interrupted call changed must not stay.
    static_cast<void>(protect(state, [&] { lua::check_frozen(state); }));
    lua_settop(state, 0);
    return error;
  }
  memory = std::move(memory_then);
  return result;
}

Script::Script(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Script::~Script() = default;

Result<std::unique_ptr<Script>> Script::load(std::string_view source, std::string_view file,
                                             std::vector<Provided> provided, const Limits& limits) {
  auto impl = std::make_unique<Impl>();
  impl->budget.limits = limits;
  impl->file = file;
  impl->provided = std::move(provided);
  impl->state = lua::new_state(impl->budget);
  if (impl->state == nullptr) return fail(ErrorCode::kState, "no memory for a script");
  RAVE_TRY(impl->run_file(source));
  return std::unique_ptr<Script>(new Script(std::move(impl)));
}

Result<std::size_t> Script::compile(std::string_view expression, const SourceLocation& where) {
  RAVE_TRY(check_power(expression, where));
  Impl& its = *impl_;
  const std::size_t number = its.expressions.size();
  lua::begin_call(its.state, its.budget);
  const bool good = protect(its.state, [&] {
    // The end of a line ends a comment of the expression, too.
    compile_text(its.state, fmt::format("return {}\n", expression), its.file);
    lua_setfield(its.state, LUA_REGISTRYINDEX, key_of(number).c_str());
  });
  if (!good) {
    auto error = its.failed(ErrorCode::kParse);
    error.value().where = where;
    return error;
  }
  its.expressions.push_back(where);
  return number;
}

Result<Value> Script::evaluate(std::size_t expression) {
  Impl& its = *impl_;
  if (expression >= its.expressions.size()) {
    return fail(ErrorCode::kNotFound, "the script has no expression {}", expression);
  }
  auto value =
      its.call([&] { lua_getfield(its.state, LUA_REGISTRYINDEX, key_of(expression).c_str()); }, {});
  if (!value) value.error().where = its.expressions[expression];
  return value;
}

bool Script::defines(std::string_view function) const {
  lua_State* const state = impl_->state;
  bool found = false;
  static_cast<void>(protect(state, [&] {
    lua_getfield(state, LUA_REGISTRYINDEX, kGlobals);
    lua::push_contents(state, -1);
    lua_pushlstring(state, function.data(), function.size());
    found = lua_rawget(state, -2) == LUA_TFUNCTION;
  }));
  lua_settop(state, 0);
  return found;
}

Result<Value> Script::call(std::string_view function, std::span<const Value> arguments) {
  if (!defines(function)) {
    return fail(ErrorCode::kNotFound, "{} defines no function `{}`", impl_->file, function);
  }
  lua_State* const state = impl_->state;
  return impl_->call(
      [&] {
        lua_getfield(state, LUA_REGISTRYINDEX, kGlobals);
        lua::push_contents(state, -1);
        lua_pushlstring(state, function.data(), function.size());
        lua_rawget(state, -2);
        lua_insert(state, -3);
        lua_pop(state, 2);
      },
      arguments);
}

const Value& Script::memory() const noexcept { return impl_->memory; }

Status Script::set_memory(const Value& memory) {
  if (memory.table() == nullptr || write_value(memory).size() > impl_->budget.limits.memory_bytes) {
    return fail(ErrorCode::kInvalidArgument, "expected a table of at most {} bytes as memory",
                impl_->budget.limits.memory_bytes);
  }
  impl_->memory = memory;
  return {};
}

}  // namespace rave::script
