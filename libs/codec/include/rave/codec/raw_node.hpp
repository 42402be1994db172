// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rave/base/error.hpp"

namespace rave::codec {

/// A YAML value with its places in the file, or one built by code. As a field type it keeps content
/// that can only be interpreted later, such as the parameters of a driver that is not loaded yet. A
/// value: copies are deep. Texts are UTF-8. Comparison ignores places, comments and quoting style.
class RawNode {
 public:
  enum class Kind : std::uint8_t { kNull, kScalar, kSequence, kMapping };

  /// A null node.
  RawNode() = default;
  [[nodiscard]] static RawNode text(std::string value);
  [[nodiscard]] static RawNode boolean(bool value);
  [[nodiscard]] static RawNode integer(std::int64_t value);
  [[nodiscard]] static RawNode unsigned_integer(std::uint64_t value);
  /// A double in the shortest form that reads back as the same value.
  [[nodiscard]] static RawNode number(double value);
  /// A scalar as it would be written without quotes: a number, true, false or plain text.
  [[nodiscard]] static RawNode plain(std::string value);
  [[nodiscard]] static RawNode sequence(std::vector<RawNode> items = {});
  /// The keys must differ.
  [[nodiscard]] static RawNode mapping(
      std::initializer_list<std::pair<std::string_view, RawNode>> entries = {});

  [[nodiscard]] Kind kind() const noexcept { return kind_; }
  [[nodiscard]] bool is_null() const noexcept { return kind_ == Kind::kNull; }
  [[nodiscard]] bool is_scalar() const noexcept { return kind_ == Kind::kScalar; }
  [[nodiscard]] bool is_sequence() const noexcept { return kind_ == Kind::kSequence; }
  [[nodiscard]] bool is_mapping() const noexcept { return kind_ == Kind::kMapping; }
  /// A scalar that is neither a number nor true or false; a quoted scalar is always a text.
  [[nodiscard]] bool is_text() const noexcept;

  /// The characters of a scalar without quotes; empty for the other kinds.
  [[nodiscard]] const std::string& scalar() const noexcept { return scalar_; }
  /// The scalar as a value of that type if it is written as one; empty otherwise. Nothing is
  /// converted: `3` is an int and a double, `3.0` only a double, `"3"` and `yes` only a text.
  [[nodiscard]] std::optional<bool> as_bool() const;
  [[nodiscard]] std::optional<std::int64_t> as_int() const;
  [[nodiscard]] std::optional<std::uint64_t> as_uint() const;
  [[nodiscard]] std::optional<double> as_double() const;
  [[nodiscard]] std::optional<std::string> as_text() const;
  /// Whether a scalar is written as an integer, of any size.
  [[nodiscard]] bool is_whole_number() const noexcept;

  /// The number of items or entries; 0 for scalars and null.
  [[nodiscard]] std::size_t size() const noexcept { return children_.size(); }
  /// The items of a sequence or the values of a mapping, in the order of the file.
  [[nodiscard]] std::span<const RawNode> children() const noexcept { return children_; }
  [[nodiscard]] const RawNode& child(std::size_t i) const { return children_[i]; }
  [[nodiscard]] RawNode& child(std::size_t i) { return children_[i]; }
  /// The name, place and comment of entry `i` of a mapping. A key that code has added has the place
  /// of its value.
  [[nodiscard]] const std::string& key(std::size_t i) const { return keys_[i].name; }
  [[nodiscard]] SourceLocation key_where(std::size_t i) const;
  [[nodiscard]] const std::string& comment(std::size_t i) const { return keys_[i].comment; }
  [[nodiscard]] std::vector<std::string_view> keys() const;
  /// The value of a key of a mapping; nullptr if there is none. Valid until the mapping changes.
  [[nodiscard]] const RawNode* find(std::string_view key) const noexcept;
  [[nodiscard]] RawNode* find(std::string_view key) noexcept;

  /// The place of the value; without a file if it was built by code.
  [[nodiscard]] SourceLocation where() const;
  /// The value in words for messages: `the number 3`, `the text "abc"`, `a list`, `a mapping`,
  /// `nothing`.
  [[nodiscard]] std::string found_text() const;

  /// Adds an item to a sequence.
  void push_back(RawNode item);
  /// Adds an entry to a mapping; the key must be new. The comment is written by to_yaml.
  void append(std::string key, RawNode value, std::string comment = {});
  /// Adds an entry or replaces the value of an existing one.
  void set(std::string_view key, RawNode value);
  /// Removes an entry; false if it does not exist.
  bool erase(std::string_view key);
  /// Sets the place; for parsers. The file name is shared by all nodes of a file, which own it
  /// together.
  void set_where(std::shared_ptr<const std::string> file, int line, int column);
  void set_key_where(std::size_t i, int line, int column);

  friend bool operator==(const RawNode& a, const RawNode& b);

 private:
  struct Key {
    std::string name;
    std::string comment;
    int line = 0;
    int column = 0;
  };
  Kind kind_ = Kind::kNull;
  bool quoted_ = false;
  int line_ = 0;
  int column_ = 0;
  std::string scalar_;
  std::vector<Key> keys_;  // one per child of a mapping, else empty
  std::vector<RawNode> children_;
  std::shared_ptr<const std::string> file_;  // owned by all nodes of one file
};

}  // namespace rave::codec
