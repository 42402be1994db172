// SPDX-License-Identifier: Apache-2.0
// How values of each type are read from a file, written and described. Errors name what was found
// and what was expected, at the place in the file.
#include "rave/codec/codecs.hpp"

#include <cmath>

#include "rave/base/names.hpp"

namespace rave::codec {
namespace {

void append_size(RawNode& schema, std::string_view key, const std::optional<std::size_t>& size) {
  if (size) schema.append(std::string(key), RawNode::unsigned_integer(*size));
}

RawNode typed_schema(std::string_view type) {
  return RawNode::mapping({{"type", RawNode::text(std::string(type))}});
}

template <class T>
std::string whole_between(T low, T high) {
  return fmt::format("a whole number (from {} to {})", low, high);
}

}  // namespace

void Codec<bool>::read(const ReadContext& context, const RawNode& node, bool& value) {
  if (const auto found = node.as_bool()) {
    value = *found;
  } else {
    context.wrong(node, "true or false");
  }
}

RawNode Codec<bool>::schema(const FieldOptions&) { return typed_schema("boolean"); }

void Codec<double>::read(const ReadContext& context, const RawNode& node, double& value) {
  const auto found = node.as_double();
  if (!found) {
    // A number that overflows is still reported as a number.
    const bool too_large = node.is_scalar() && !node.is_text() && !node.as_bool();
    context.wrong(node, too_large ? number_expectation("a number within the range of a double",
                                                       context.options)
                                  : expectation(context.options));
  } else if (!std::isfinite(*found)) {
    context.wrong(node, number_expectation("a finite number", context.options));
  } else if (!in_range(*found, context.options)) {
    context.wrong(node, expectation(context.options));
  } else {
    value = *found;
  }
}

void Codec<std::string>::read(const ReadContext& context, const RawNode& node, std::string& value) {
  if (!node.is_text()) {
    // `name: 12` or `name: true` is no text in YAML; who wrote it most likely forgot the quotes.
    const std::string_view hint = node.is_scalar() ? " (put it in quotes)" : "";
    context.wrong(node, fmt::format("{}{}", expectation(context.options), hint));
  } else if (!in_length(node.scalar().size(), context.options)) {
    context.wrong(node, expectation(context.options));
  } else {
    value = node.scalar();
  }
}

RawNode Codec<std::string>::schema(const FieldOptions& options) {
  RawNode schema = typed_schema("string");
  append_size(schema, "minLength", options.min_items);
  append_size(schema, "maxLength", options.max_items);
  return schema;
}

std::string Codec<std::string>::expectation(const FieldOptions& options) {
  if (options.min_items == 1 && !options.max_items) return "text that is not empty";
  return "text" + length_expectation(options, "byte");
}

namespace detail {

void read_signed(const ReadContext& context, const RawNode& node, std::int64_t low,
                 std::int64_t high, std::int64_t& value) {
  const auto found = node.as_int();
  const std::string expected = number_expectation("a whole number", context.options);
  const bool whole = found || node.is_whole_number();
  if (whole && (!found || *found < low || *found > high)) {
    // The limits of the type are printed only if the field has none of its own.
    const bool limited = context.options.min && context.options.max;
    context.wrong(node, limited ? expected : whole_between(low, high));
  } else if (!whole || !in_range(static_cast<double>(*found), context.options)) {
    context.wrong(node, expected);
  } else {
    value = *found;
  }
}

void read_unsigned(const ReadContext& context, const RawNode& node, std::uint64_t high,
                   std::uint64_t& value) {
  FieldOptions options = context.options;
  if (!options.min) options.min = 0;
  const auto found = node.as_uint();
  const std::string expected = number_expectation("a whole number", options);
  const bool whole = found || (node.is_whole_number() && node.scalar()[0] != '-');
  if (whole && (!found || *found > high)) {
    context.wrong(node, options.max ? expected : whole_between(std::uint64_t{0}, high));
  } else if (!whole || !in_range(static_cast<double>(*found), options)) {
    context.wrong(node, expected);
  } else {
    value = *found;
  }
}

RawNode number_schema(std::string_view type, const FieldOptions& options) {
  RawNode schema = typed_schema(type);
  if (options.min) {
    schema.append(options.exclusive_min ? "exclusiveMinimum" : "minimum",
                  RawNode::number(*options.min));
  }
  if (options.max) {
    schema.append(options.exclusive_max ? "exclusiveMaximum" : "maximum",
                  RawNode::number(*options.max));
  }
  return schema;
}

RawNode list_schema(RawNode items, const FieldOptions& options) {
  RawNode schema = typed_schema("array");
  schema.append("items", std::move(items));
  append_size(schema, "minItems", options.min_items);
  append_size(schema, "maxItems", options.max_items);
  return schema;
}

RawNode map_schema(RawNode values, const FieldOptions& options) {
  RawNode schema = typed_schema("object");
  schema.append("additionalProperties", std::move(values));
  append_size(schema, "minProperties", options.min_items);
  append_size(schema, "maxProperties", options.max_items);
  return schema;
}

RawNode enum_schema(std::span<const std::string_view> names) {
  RawNode schema = typed_schema("string");
  RawNode values = RawNode::sequence();
  for (const std::string_view name : names) values.push_back(RawNode::text(std::string(name)));
  schema.append("enum", std::move(values));
  return schema;
}

RawNode nullable_schema(RawNode schema) {
  return RawNode::mapping(
      {{"anyOf", RawNode::sequence({std::move(schema), typed_schema("null")})}});
}

std::string enum_expectation(std::span<const std::string_view> names) {
  return fmt::format("one of {}", join_names(names));
}

int read_enum(const ReadContext& context, const RawNode& node,
              std::span<const std::string_view> names) {
  if (node.is_text()) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == node.scalar()) return static_cast<int>(i);
    }
  }
  std::string expected = enum_expectation(names);
  if (node.is_text()) {
    // The nearest name, since most wrong choices are slips of the finger.
    const std::string_view near = nearest_name(node.scalar(), names);
    if (!near.empty()) expected += fmt::format("; did you mean `{}`?", near);
  }
  context.wrong(node, expected);
  return -1;
}

bool check_collection(const ReadContext& context, const RawNode& node, RawNode::Kind kind,
                      std::string_view expected) {
  if (node.kind() != kind) {
    context.wrong(node, expected);
    return false;
  }
  if (in_length(node.size(), context.options)) return true;
  const std::string_view item = kind == RawNode::Kind::kMapping ? "entry" : "item";
  context.error(node, fmt::format("found {} of {} {}, expected {}", node.found_text(), node.size(),
                                  plural(item, node.size()), expected));
  return false;
}

// Limits of length are those of the list; limits of numbers are those of its elements.
FieldOptions element_options(const FieldOptions& options) {
  FieldOptions element = options;
  element.min_items.reset();
  element.max_items.reset();
  return element;
}

std::string item_label(const ReadContext& context, std::size_t index) {
  return context.label.empty() ? fmt::format("item {}", index + 1)
                               : fmt::format("item {} of {}", index + 1, context.label);
}

}  // namespace detail
}  // namespace rave::codec
