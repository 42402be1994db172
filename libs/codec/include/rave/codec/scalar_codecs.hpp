// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <type_traits>

#include "rave/codec/codec_support.hpp"

// Codecs of bool, numbers, texts, enums and trees; codec_base.hpp documents their functions.
namespace rave::codec {

template <>
struct Codec<bool> {
  static void read(const ReadContext& context, const RawNode& node, bool& value);
  static RawNode write(bool value) { return RawNode::boolean(value); }
  static RawNode schema(const FieldOptions& options);
  static std::string expectation(const FieldOptions&) { return "true or false"; }
};

template <>
struct Codec<double> {
  static void read(const ReadContext& context, const RawNode& node, double& value);
  static RawNode write(double value) { return RawNode::number(value); }
  static RawNode schema(const FieldOptions& o) { return detail::number_schema("number", o); }
  static std::string expectation(const FieldOptions& o) {
    return number_expectation("a number", o);
  }
};

template <>
struct Codec<std::string> {
  static void read(const ReadContext& context, const RawNode& node, std::string& value);
  static RawNode write(const std::string& value) { return RawNode::text(value); }
  static RawNode schema(const FieldOptions& options);
  static std::string expectation(const FieldOptions& options);
};

template <>
struct Codec<RawNode> {
  static void read(const ReadContext&, const RawNode& node, RawNode& value) { value = node; }
  static RawNode write(const RawNode& value) { return value; }
  static RawNode schema(const FieldOptions&) { return RawNode::mapping(); }
  static std::string expectation(const FieldOptions&) { return "a value"; }
};

template <std::integral T>
struct Codec<T> {
  static void read(const ReadContext& context, const RawNode& node, T& value) {
    using Limits = std::numeric_limits<T>;
    if constexpr (std::is_signed_v<T>) {
      std::int64_t wide = value;
      detail::read_signed(context, node, Limits::min(), Limits::max(), wide);
      value = static_cast<T>(wide);
    } else {
      std::uint64_t wide = value;
      detail::read_unsigned(context, node, Limits::max(), wide);
      value = static_cast<T>(wide);
    }
  }
  static RawNode write(T value) {
    if constexpr (std::is_signed_v<T>) return RawNode::integer(value);
    return RawNode::unsigned_integer(static_cast<std::uint64_t>(value));
  }
  static RawNode schema(const FieldOptions& o) {
    FieldOptions options = o;
    if (!std::is_signed_v<T> && !options.min) options.min = 0;
    return detail::number_schema("integer", options);
  }
  static std::string expectation(const FieldOptions& o) {
    FieldOptions options = o;
    if (!std::is_signed_v<T> && !options.min) options.min = 0;
    return number_expectation("a whole number", options);
  }
};

template <class T>
  requires std::is_enum_v<T>
struct Codec<T> {
  static constexpr auto kNames = detail::name_column<T>();
  static void read(const ReadContext& context, const RawNode& node, T& value) {
    const int row = detail::read_enum(context, node, kNames);
    if (row >= 0) value = enum_names(EnumTag<T>{})[static_cast<std::size_t>(row)].value;
  }
  static RawNode write(T value) {
    for (const auto& row : enum_names(EnumTag<T>{})) {
      if (row.value == value) return RawNode::text(std::string(row.name));
    }
    return {};
  }
  static RawNode schema(const FieldOptions&) { return detail::enum_schema(kNames); }
  static std::string expectation(const FieldOptions&) { return detail::enum_expectation(kNames); }
};

}  // namespace rave::codec
