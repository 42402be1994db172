// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace rave {

/// A table of words and of what each stands for, such as
/// `constexpr WordTable<Side, 2> kSides = {{{"left", Side::kLeft}, {"right", Side::kRight}}};`
/// For a table that grows, word_table() counts the rows.
template <class Value, std::size_t kRows>
struct WordTable {
  std::pair<std::string_view, Value> rows[kRows];

  /// The first word for `value`; `otherwise` if it has none.
  [[nodiscard]] constexpr std::string_view of(Value value,
                                              std::string_view otherwise = {}) const noexcept {
    for (const auto& [word, its] : rows) {
      if (its == value) return word;
    }
    return otherwise;
  }
  /// What `word` stands for; empty: it is not in the table.
  [[nodiscard]] constexpr std::optional<Value> find(std::string_view word) const noexcept {
    for (const auto& [its, value] : rows) {
      if (its == word) return value;
    }
    return std::nullopt;
  }
  /// The words in the order of the table, for messages.
  [[nodiscard]] constexpr std::array<std::string_view, kRows> words() const noexcept {
    std::array<std::string_view, kRows> words{};
    for (std::size_t i = 0; i < kRows; ++i) words[i] = rows[i].first;
    return words;
  }
};

/// A table of as many rows as are given:
/// `constexpr auto kSides = word_table<Side>({{"left", Side::kLeft}, {"right", Side::kRight}});`
template <class Value, std::size_t kRows>
[[nodiscard]] constexpr WordTable<Value, kRows> word_table(
    const std::pair<std::string_view, Value> (&rows)[kRows]) noexcept {
  WordTable<Value, kRows> table{};
  for (std::size_t i = 0; i < kRows; ++i) table.rows[i] = rows[i];
  return table;
}

}  // namespace rave
