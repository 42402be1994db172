// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rave/codec/codec_support.hpp"
#include "rave/codec/located.hpp"

// Codecs of types that contain other values: Located, optional, list, array and map.
namespace rave::codec {

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
    if (!detail::check_collection(context, node, RawNode::Kind::kSequence,
                                  expectation(context.options)))
      return;
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

template <class T, std::size_t kCount>
struct Codec<std::array<T, kCount>> {
  static void read(const ReadContext& context, const RawNode& node, std::array<T, kCount>& value) {
    const FieldOptions fixed = with_length(context.options);
    if (!detail::check_collection({context.diagnostics, fixed, context.label}, node,
                                  RawNode::Kind::kSequence, expectation(context.options))) {
      return;
    }
    const FieldOptions options = detail::element_options(fixed);
    for (std::size_t i = 0; i < kCount; ++i) {
      Codec<T>::read({context.diagnostics, options, detail::item_label(context, i)}, node.child(i),
                     value[i]);
    }
  }
  static RawNode write(const std::array<T, kCount>& value) {
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
    options.min_items = kCount;
    options.max_items = kCount;
    return options;
  }
};

template <class T>
struct Codec<std::map<std::string, T>> {
  static void read(const ReadContext& context, const RawNode& node,
                   std::map<std::string, T>& value) {
    if (!detail::check_collection(context, node, RawNode::Kind::kMapping,
                                  expectation(context.options)))
      return;
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

}  // namespace rave::codec
