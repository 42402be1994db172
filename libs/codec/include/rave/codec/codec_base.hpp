// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "rave/codec/diagnostics.hpp"
#include "rave/codec/field_options.hpp"
#include "rave/codec/raw_node.hpp"

namespace rave::codec {

/// The context of reading one value.
struct ReadContext {
  Diagnostics& diagnostics;
  const FieldOptions& options;
  /// The name of the value in messages, such as "`range_m`" or "item 3 of `mounts`"; may be empty.
  std::string label;

  /// Reports `label: found …, expected …` at the node.
  void wrong(const RawNode& node, std::string_view expected) const;
  /// Reports a message at the node.
  void error(const RawNode& node, std::string message) const;
};

/// How one type is read, written and described. Specialise it for a type of your own that is not a
/// described struct; the four functions have the signatures of those in codecs.hpp:
///   static void read(const ReadContext&, const RawNode&, T&);      reports to the diagnostics
///   static RawNode write(const T&);
///   static RawNode schema(const FieldOptions&);                    a JSON Schema as a mapping
///   static std::string expectation(const FieldOptions&);           "a number (in metres)"
template <class T>
struct Codec;

/// One row of the name table of an enum.
template <class E>
struct EnumName {
  E value;
  std::string_view name;
  constexpr EnumName(E v, std::string_view n) noexcept : value(v), name(n) {}
};

/// Selects the name table of an enum. In the enum's namespace write
/// `constexpr auto enum_names(rave::codec::EnumTag<Role>) {
///    return std::array{rave::codec::EnumName{Role::kObserver, "observer"}, …}; }`
template <class E>
struct EnumTag {};

/// Passed to `validate(const T&, CheckContext&)`, which checks conditions between fields. It is
/// called after the struct was read without errors.
class CheckContext {
 public:
  CheckContext(const RawNode& mapping, Diagnostics& diagnostics)
      : mapping_(mapping), diagnostics_(diagnostics) {}

  /// Reports an error at the value of `key`, or at the mapping if the key is missing or empty.
  template <class... Args>
  void error(std::string_view key, fmt::format_string<Args...> format, Args&&... args) {
    report(key, fmt::format(format, std::forward<Args>(args)...));
  }
  /// Reports an error at the given place, such as that of a Located value further down.
  template <class... Args>
  void error_at(SourceLocation where, fmt::format_string<Args...> format, Args&&... args) {
    diagnostics_.add(std::move(where), fmt::format(format, std::forward<Args>(args)...));
  }
  /// Where the struct stands in the file.
  [[nodiscard]] SourceLocation where() const { return mapping_.where(); }
  /// The mapping as read, to test whether a key was given.
  [[nodiscard]] const RawNode& node() const noexcept { return mapping_; }

 private:
  void report(std::string_view key, std::string message);

  const RawNode& mapping_;
  Diagnostics& diagnostics_;
};

}  // namespace rave::codec
