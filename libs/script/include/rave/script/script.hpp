// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/error.hpp"
#include "rave/base/result.hpp"
#include "rave/script/value.hpp"

namespace rave::script {

/// What one call of a script may use. A script that needs more fails; nothing hangs.
struct Limits {
  std::uint64_t instructions = 1'000'000;     ///< Of Lua's machine, per call; counted in thousands.
  std::size_t bytes = std::size_t{4} << 20U;  ///< All that its state holds at any time.
  std::size_t memory_bytes = std::size_t{64} << 10U;  ///< Of `memory`, as write_value() counts.
};

/// A function of the program that a script calls. The arguments are valid during the call. An error
/// becomes an error of the script at the line of the call.
using Function = std::function<Result<Value>(std::span<const Value> arguments)>;

/// A function with the name by which scripts call it; `table.name` puts it into a table.
struct Provided {
  std::string name;
  Function function;
};

/// A Lua 5.4 script in a sandbox that gives the same results on every machine and in every process:
/// - no files, no loading of code, no time, no addresses; sine and its kin of rave/math; `pairs`
///   goes through whole numbers and then texts in ascending order; `table.sort` is stable; the
///   power operator is refused for `math.pow`, which is made of rave::exp and rave::log;
/// - what it keeps between calls is the table `memory`, which holds plain values. All other tables
///   and variables are constant once the file has run, so that a script that continues from
///   memory() in another process does the same;
/// - a budget of instructions and bytes per call.
/// Errors have the code kPlugin (kParse for the syntax) and the place in the file. After an error
/// the script may be called again; its memory is that of the last call that succeeded.
/// One thread at a time; functions provided to it are called on that thread.
class Script {
 public:
  /// Runs the file once. `file` names it in errors. Errors: syntax, errors while it runs.
  [[nodiscard]] static Result<std::unique_ptr<Script>> load(std::string_view source,
                                                            std::string_view file,
                                                            std::vector<Provided> provided,
                                                            const Limits& limits = {});
  ~Script();
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;

  /// An expression that evaluate() computes, such as `distance("rover", "dock") < 0.5`. It sees
  /// what the file defines. `where` is its place, for errors.
  [[nodiscard]] Result<std::size_t> compile(std::string_view expression,
                                            const SourceLocation& where);
  /// The value of an expression.
  [[nodiscard]] Result<Value> evaluate(std::size_t expression);

  /// Whether the file defines a function of this name.
  [[nodiscard]] bool defines(std::string_view function) const;
  /// Calls a function of the file. Errors also: kNotFound.
  [[nodiscard]] Result<Value> call(std::string_view function, std::span<const Value> arguments);

  /// `memory` after the last call; a table.
  [[nodiscard]] const Value& memory() const noexcept;
  /// Continues from a memory. Error kInvalidArgument: no table, or larger than the limit.
  [[nodiscard]] Status set_memory(const Value& memory);

 private:
  struct Impl;
  explicit Script(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::script
