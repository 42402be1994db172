// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/codec_base.hpp"
#include "rave/config/located.hpp"
#include "rave/config/visitors.hpp"

// The codecs of the supported types; see codec_base.hpp for what the four functions do.
namespace rave::config {

namespace detail {

void read_signed(const ReadContext& context, const RawNode& node, std::int64_t low,
                 std::int64_t high, std::int64_t& value);
void read_unsigned(const ReadContext& context, const RawNode& node, std::uint64_t high,
                   std::uint64_t& value);
RawNode number_schema(std::string_view type, const FieldOptions& options);
RawNode list_schema(RawNode items, const FieldOptions& options);
RawNode map_schema(RawNode values, const FieldOptions& options);
RawNode enum_schema(std::span<const std::string_view> names);
RawNode nullable_schema(RawNode schema);
RawNode shorthand_schema(RawNode schema);
/// The row of the table that the node names, or -1 after reporting.
int read_enum(const ReadContext& context, const RawNode& node,
              std::span<const std::string_view> names);
std::string enum_expectation(std::span<const std::string_view> names);
/// Whether the node is a list (or mapping) of allowed length; reports if not.
bool check_list(const ReadContext& context, const RawNode& node, std::string_view expected);
bool check_map(const ReadContext& context, const RawNode& node, std::string_view expected);
/// The options of the elements: those of the whole without the limits on its length.
FieldOptions element_options(const FieldOptions& options);
std::string item_label(const ReadContext& context, std::size_t index);
void add_shorthand(const ReadContext& context, const RawNode& node, Status status);
void add_validation(const RawNode& node, Diagnostics& diagnostics, Status status);

template <class E>
constexpr auto name_column() {
  constexpr auto table = enum_names(EnumTag<E>{});
  std::array<std::string_view, table.size()> names{};
  for (std::size_t i = 0; i < table.size(); ++i) names[i] = table[i].name;
  return names;
}

}  // namespace detail

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

template <class T>
struct Codec<Located<T>> {
  static void read(const ReadContext& context, const RawNode& node, Located<T>& value) {
    value.where = node.where();
    Codec<T>::read(context, node, value.value);
  }
  static RawNode write(const Located<T>& value) { return Codec<T>::write(value.value); }
  static RawNode schema(const FieldOptions& o) { return Codec<T>::schema(o); }
  static std::string expectation(const FieldOptions& o) { return Codec<T>::expectation(o); }
};

template <class T>
struct Codec<std::optional<T>> {
  static void read(const ReadContext& context, const RawNode& node, std::optional<T>& value) {
    value.reset();
    if (!node.is_null()) Codec<T>::read(context, node, value.emplace());
  }
  static RawNode write(const std::optional<T>& value) {
    return value ? Codec<T>::write(*value) : RawNode{};
  }
  static RawNode schema(const FieldOptions& o) {
    return detail::nullable_schema(Codec<T>::schema(o));
  }
  static std::string expectation(const FieldOptions& o) { return Codec<T>::expectation(o); }
};

template <class T>
struct Codec<std::vector<T>> {
  static void read(const ReadContext& context, const RawNode& node, std::vector<T>& value) {
    if (!detail::check_list(context, node, expectation(context.options))) return;
    value.clear();
    value.reserve(node.size());
    const FieldOptions options = detail::element_options(context.options);
    for (std::size_t i = 0; i < node.size(); ++i) {
      T item{};
      Codec<T>::read({context.diagnostics, options, detail::item_label(context, i)}, node.child(i),
                     item);
      value.push_back(std::move(item));
    }
  }
  static RawNode write(const std::vector<T>& value) {
    RawNode node = RawNode::sequence();
    for (const auto& item : value) node.push_back(Codec<T>::write(item));
    return node;
  }
  static RawNode schema(const FieldOptions& o) {
    return detail::list_schema(Codec<T>::schema(detail::element_options(o)), o);
  }
  static std::string expectation(const FieldOptions& o) {
    return fmt::format("a list{}, each {}", length_expectation(o, "item"),
                       Codec<T>::expectation(detail::element_options(o)));
  }
};

template <class T, std::size_t N>
struct Codec<std::array<T, N>> {
  static void read(const ReadContext& context, const RawNode& node, std::array<T, N>& value) {
    const FieldOptions fixed = with_length(context.options);
    if (!detail::check_list({context.diagnostics, fixed, context.label}, node,
                            expectation(context.options))) {
      return;
    }
    const FieldOptions options = detail::element_options(fixed);
    for (std::size_t i = 0; i < N; ++i) {
      Codec<T>::read({context.diagnostics, options, detail::item_label(context, i)}, node.child(i),
                     value[i]);
    }
  }
  static RawNode write(const std::array<T, N>& value) {
    RawNode node = RawNode::sequence();
    for (const T& item : value) node.push_back(Codec<T>::write(item));
    return node;
  }
  static RawNode schema(const FieldOptions& o) {
    return detail::list_schema(Codec<T>::schema(detail::element_options(o)), with_length(o));
  }
  static std::string expectation(const FieldOptions& o) {
    return Codec<std::vector<T>>::expectation(with_length(o));
  }

 private:
  static FieldOptions with_length(const FieldOptions& o) {
    FieldOptions options = o;
    options.min_items = N;
    options.max_items = N;
    return options;
  }
};

template <class T>
struct Codec<std::map<std::string, T>> {
  static void read(const ReadContext& context, const RawNode& node,
                   std::map<std::string, T>& value) {
    if (!detail::check_map(context, node, expectation(context.options))) return;
    value.clear();
    const FieldOptions options = detail::element_options(context.options);
    for (std::size_t i = 0; i < node.size(); ++i) {
      Codec<T>::read({context.diagnostics, options, fmt::format("`{}`", node.key(i))},
                     node.child(i), value[node.key(i)]);
    }
  }
  static RawNode write(const std::map<std::string, T>& value) {
    RawNode node = RawNode::mapping();
    for (const auto& [key, item] : value) node.append(key, Codec<T>::write(item));
    return node;
  }
  static RawNode schema(const FieldOptions& o) {
    return detail::map_schema(Codec<T>::schema(detail::element_options(o)), o);
  }
  static std::string expectation(const FieldOptions& o) {
    return fmt::format("a mapping{}, each value {}", length_expectation(o, "entry"),
                       Codec<T>::expectation(detail::element_options(o)));
  }
};

/// A struct that `describe` is defined for.
template <class T>
concept Described = std::is_class_v<T> && requires(Writer& v, T& c) { describe(v, c); };

template <Described T>
struct Codec<T> {
  static constexpr bool kHasShorthand = requires(const RawNode& n, T& c) {
    { read_shorthand(n, c) } -> std::same_as<Status>;
  };

  static void read(const ReadContext& context, const RawNode& node, T& value) {
    const std::size_t errors_before = context.diagnostics.size();
    if (node.is_mapping()) {
      Reader reader(node, context.diagnostics);
      describe(reader, value);
      reader.finish();
    } else if constexpr (kHasShorthand) {
      detail::add_shorthand(context, node, read_shorthand(node, value));
    } else {
      context.wrong(node, "a mapping");
    }
    if (context.diagnostics.size() != errors_before) return;
    if constexpr (requires(CheckContext& c) { validate(value, c); }) {
      CheckContext check(node, context.diagnostics);
      validate(std::as_const(value), check);
    } else if constexpr (requires { validate(value); }) {
      detail::add_validation(node, context.diagnostics, validate(std::as_const(value)));
    }
  }
  static RawNode write(const T& value) {
    Writer writer;
    // One describe serves readers and writers, so it takes the struct by mutable reference; the
    // writer only reads.
    describe(writer, const_cast<T&>(value));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    return std::move(writer).take();
  }
  static RawNode schema(const FieldOptions&) {
    SchemaWriter writer;
    T value{};
    describe(writer, value);
    RawNode schema = std::move(writer).take();
    return kHasShorthand ? detail::shorthand_schema(std::move(schema)) : schema;
  }
  static std::string expectation(const FieldOptions&) { return "a mapping"; }
};

}  // namespace rave::config
