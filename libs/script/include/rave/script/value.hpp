// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::script {

/// A plain value of a script: what its memory holds and what it exchanges with the program around
/// it. A value type: copies are deep.
struct Value {
  /// Keys of tables: whole numbers before texts, each in ascending order.
  using Key = std::variant<std::int64_t, std::string>;
  struct Entry;
  using Table = std::vector<Entry>;  ///< Sorted by key; each key once.

  std::variant<std::monostate, bool, std::int64_t, double, std::string, Table> is;

  Value() = default;
  // Implicit on purpose: arguments of calls are written as plain values.
  Value(bool value) : is(value) {}                      // NOLINT(google-explicit-*)
  Value(double value) : is(value) {}                    // NOLINT(google-explicit-*)
  Value(std::int64_t value) : is(value) {}              // NOLINT(google-explicit-*)
  Value(std::string value) : is(std::move(value)) {}    // NOLINT(google-explicit-*)
  Value(const char* value) : is(std::string(value)) {}  // NOLINT(google-explicit-*)
  Value(Table table);                                   // NOLINT(google-explicit-*)

  [[nodiscard]] bool is_nil() const noexcept { return is.index() == 0; }
  /// As Lua decides in `if`: everything but nil and false.
  [[nodiscard]] bool holds() const noexcept;
  /// A number of either kind as a double; `otherwise` for anything else.
  [[nodiscard]] double number_or(double otherwise) const noexcept;
  /// The text; nullptr for anything else.
  [[nodiscard]] const std::string* text() const noexcept { return std::get_if<std::string>(&is); }
  [[nodiscard]] const Table* table() const noexcept { return std::get_if<Table>(&is); }
  /// The value of a key of a table; nullptr if this is no table or has no such key.
  [[nodiscard]] const Value* find(std::string_view key) const noexcept;
  [[nodiscard]] const Value* find(std::int64_t key) const noexcept;

  friend bool operator==(const Value& a, const Value& b) noexcept;
};

struct Value::Entry {
  Key key;
  Value value;
  friend bool operator==(const Entry&, const Entry&) = default;
};

/// The kind in words for messages: `nothing`, `true or false`, `a number`, `a text`, `a table`.
[[nodiscard]] std::string_view kind_text(const Value& value) noexcept;

/// The value as Lua writes it, such as `{1, n = 0.5, on = true}`, for messages and tests.
[[nodiscard]] std::string to_text(const Value& value);
/// For GoogleTest.
void PrintTo(const Value& value, std::ostream* out);  // NOLINT(readability-identifier-naming)

/// Largest nesting of tables in a value.
inline constexpr int kMaxValueDepth = 16;

/// Bytes that read_value() makes the same value of, to the bit of each number.
[[nodiscard]] std::vector<std::byte> write_value(const Value& value);
/// Error kParse: cut off, an unknown kind, keys out of order, too deep, or bytes left over.
[[nodiscard]] Result<Value> read_value(std::span<const std::byte> bytes);

}  // namespace rave::script
