// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <type_traits>
#include <utility>

#include "rave/codec/codec_support.hpp"
#include "rave/codec/visitors.hpp"

namespace rave::codec {

/// A struct for which `describe` is defined.
template <class T>
concept Described = std::is_class_v<T> && requires(Writer& v, T& c) { describe(v, c); };

template <Described T>
struct Codec<T> {
  static void read(const ReadContext& context, const RawNode& node, T& value) {
    const std::size_t errors_before = context.diagnostics.size();
    if (node.is_mapping()) {
      Reader reader(node, context.diagnostics);
      describe(reader, value);
      reader.finish();
    } else {
      context.wrong(node, "a mapping");
    }
    if (context.diagnostics.size() != errors_before) return;
    if constexpr (requires(CheckContext& c) { validate(value, c); }) {
      CheckContext check(node, context.diagnostics);
      validate(std::as_const(value), check);
    }
  }
  static RawNode write(const T& value) {
    Writer writer;
    // The same describe() serves readers and writers, so it takes the struct by mutable reference;
    // the writer only reads it.
    describe(writer, const_cast<T&>(value));  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    return std::move(writer).take();
  }
  static RawNode schema(const FieldOptions&) {
    SchemaWriter writer;
    T value{};
    describe(writer, value);
    return std::move(writer).take();
  }
  static std::string expectation(const FieldOptions&) { return "a mapping"; }
};

}  // namespace rave::codec
