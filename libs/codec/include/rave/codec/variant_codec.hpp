// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <concepts>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "rave/codec/codec_support.hpp"
#include "rave/codec/struct_codec.hpp"

namespace rave::codec {

/// A struct that names itself, so that it can be one of a variant; it is described, or has a codec:
///   struct Goal { static constexpr std::string_view kName = "goal"; … };
template <class T>
concept Named = requires {
  { T::kName } -> std::convertible_to<std::string_view>;
};

/// The key of a mapping that says which of a variant it is.
inline constexpr std::string_view kVariantKey = "do";

/// The names of a variant's structs, in their order.
template <class... T>
[[nodiscard]] constexpr std::array<std::string_view, sizeof...(T)> variant_names(
    const std::variant<T...>* /*type*/) noexcept {
  return {T::kName...};
}

/// The name of what a variant holds.
template <Named... T>
[[nodiscard]] std::string_view name_of(const std::variant<T...>& value) noexcept {
  return variant_names(&value)[value.index()];
}

namespace detail {
/// The tree without kVariantKey, which no struct of the variant describes.
[[nodiscard]] RawNode without_variant_key(const RawNode& node);
/// The row that the mapping names; -1 after reporting.
[[nodiscard]] int read_variant_name(const ReadContext& context, const RawNode& node,
                                    std::span<const std::string_view> names);
[[nodiscard]] RawNode with_variant_key(std::string_view name, RawNode node);
/// Adds the constant key to the schema of a struct.
[[nodiscard]] RawNode named_schema(std::string_view name, RawNode schema);
[[nodiscard]] RawNode any_schema(std::vector<RawNode> schemas);
}  // namespace detail

/// One of several structs: a mapping with the keys of that struct, and its name at kVariantKey.
template <Named... T>
struct Codec<std::variant<T...>> {
  static constexpr std::array<std::string_view, sizeof...(T)> kNames = {T::kName...};

  static void read(const ReadContext& context, const RawNode& node, std::variant<T...>& value) {
    const int row = detail::read_variant_name(context, node, kNames);
    if (row < 0) return;
    const RawNode rest = detail::without_variant_key(node);
    int i = 0;
    // Exactly one of them has the row that was named.
    (void)((i++ == row && (read_one<T>(context, rest, value), true)) || ...);
  }
  static RawNode write(const std::variant<T...>& value) {
    return std::visit(
        []<class One>(const One& one) {
          return detail::with_variant_key(One::kName, Codec<One>::write(one));
        },
        value);
  }
  static RawNode schema(const FieldOptions& options) {
    return detail::any_schema({detail::named_schema(T::kName, Codec<T>::schema(options))...});
  }
  static std::string expectation(const FieldOptions&) {
    return "a mapping whose `" + std::string(kVariantKey) + "` is " +
           detail::enum_expectation(kNames);
  }

 private:
  template <class One>
  static void read_one(const ReadContext& context, const RawNode& node, std::variant<T...>& value) {
    Codec<One>::read(context, node, value.template emplace<One>());
  }
};

}  // namespace rave::codec
