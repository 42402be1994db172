// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rave/codec/codec_base.hpp"

// What `describe(v, config)` is called with. All have the same functions:
//   v.field(name, member, options)     may be left out: then the member keeps its initial value
//   v.required(name, member, options)  must be given
namespace rave::codec {
namespace detail {

/// A key that a mapping may have, and the unit of its value.
struct KnownKey {
  std::string_view name;
  std::string_view unit;
};

/// Reports each key of the mapping that is not a known one. `prefix` begins the messages.
void report_unknown_keys(const RawNode& mapping, std::span<const KnownKey> known,
                         std::string_view prefix, Diagnostics& diagnostics);

/// The comment of a written field: `[m] Sentence.`
[[nodiscard]] std::string comment_of(const FieldOptions& options);

}  // namespace detail

/// Reads the entries of a mapping into a struct.
class Reader {
 public:
  Reader(const RawNode& mapping, Diagnostics& diagnostics)
      : mapping_(mapping), diagnostics_(diagnostics) {}

  template <class T>
  void field(std::string_view name, T& target, const FieldOptions& options = {}) {
    if (const RawNode* node = take(name, options)) read(name, *node, target, options);
  }
  template <class T>
  void required(std::string_view name, T& target, const FieldOptions& options = {}) {
    if (const RawNode* node = take(name, options)) {
      read(name, *node, target, options);
    } else {
      missing(name, Codec<T>::expectation(options));
    }
  }

  /// Reports the keys that no field used. Call it once, after describe.
  void finish() { detail::report_unknown_keys(mapping_, known_, "", diagnostics_); }

 private:
  template <class T>
  void read(std::string_view name, const RawNode& node, T& target, const FieldOptions& options) {
    const ReadContext context{diagnostics_, options, fmt::format("`{}`", name)};
    Codec<T>::read(context, node, target);
  }
  const RawNode* take(std::string_view name, const FieldOptions& options);
  void missing(std::string_view name, std::string_view expected);

  const RawNode& mapping_;
  Diagnostics& diagnostics_;
  std::vector<detail::KnownKey> known_;
};

/// Writes a struct as a mapping with comments.
class Writer {
 public:
  template <class T>
  void field(std::string_view name, const T& value, const FieldOptions& options = {}) {
    mapping_.append(std::string(name), Codec<T>::write(value), detail::comment_of(options));
  }
  template <class T>
  void required(std::string_view name, const T& value, const FieldOptions& options = {}) {
    field(name, value, options);
  }

  [[nodiscard]] RawNode take() && { return std::move(mapping_); }

 private:
  RawNode mapping_ = RawNode::mapping();
};

/// Makes the JSON Schema of a struct.
class SchemaWriter {
 public:
  template <class T>
  void field(std::string_view name, const T& value, const FieldOptions& options = {}) {
    const RawNode initial = Codec<T>::write(value);
    add(name, Codec<T>::schema(options), options, &initial);
  }
  template <class T>
  void required(std::string_view name, const T& /*value*/, const FieldOptions& options = {}) {
    add(name, Codec<T>::schema(options), options, nullptr);
    required_.push_back(RawNode::text(std::string(name)));
  }

  [[nodiscard]] RawNode take() &&;

 private:
  void add(std::string_view name, const RawNode& schema, const FieldOptions& options,
           const RawNode* initial);

  RawNode properties_ = RawNode::mapping();
  RawNode required_ = RawNode::sequence();
};

}  // namespace rave::codec
