// SPDX-License-Identifier: Apache-2.0
// The visitors that describe() of each struct goes through: reading, checking, writing, schema.
#include "rave/codec/visitors.hpp"

#include <algorithm>

#include "rave/base/names.hpp"
#include "rave/codec/nodes.hpp"
#include "rave/codec/text_output.hpp"

namespace rave::codec {
namespace {

std::string unknown_key_message(std::string_view key, std::span<const detail::KnownKey> known) {
  std::vector<std::string_view> names;
  for (const auto& [name, unit] : known) {
    // `range` instead of `range_m` is the most likely mistake, and deserves the unit in the answer.
    if (!unit.empty() && name.size() > key.size() && name.starts_with(key) &&
        name[key.size()] == '_') {
      return fmt::format("unknown key `{}`: unit missing: expected `{}` ({})", key, name,
                         unit_words(unit));
    }
    names.push_back(name);
  }
  return fmt::format("unknown key `{}`{}", key, suggestion(key, names));
}

}  // namespace

void detail::report_unknown_keys(const RawNode& mapping, std::span<const KnownKey> known,
                                 std::string_view prefix, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < mapping.size(); ++i) {
    const std::string& key = mapping.key(i);
    if (std::ranges::find(known, key, &KnownKey::name) != known.end()) continue;
    diagnostics.add(mapping.key_where(i),
                    fmt::format("{}{}", prefix, unknown_key_message(key, known)));
  }
}

std::string detail::comment_of(const FieldOptions& options) {
  if (options.unit.empty()) return std::string(options.doc);
  return fmt::format("[{}]{}{}", options.unit, options.doc.empty() ? "" : " ", options.doc);
}

void ReadContext::wrong(const RawNode& node, std::string_view expected) const {
  error(node, fmt::format("found {}, expected {}", node.found_text(), expected));
}

void ReadContext::error(const RawNode& node, std::string message) const {
  if (!label.empty()) message = fmt::format("{}: {}", label, message);
  diagnostics.add(node.where(), std::move(message));
}

void CheckContext::report(std::string_view key, std::string message) {
  const RawNode* node = key.empty() ? nullptr : mapping_.find(key);
  diagnostics_.add(node ? node->where() : mapping_.where(), std::move(message));
}

const RawNode* Reader::take(std::string_view name, const FieldOptions& options) {
  // Keys that describe() asks for are the known ones; all others are errors in finish().
  known_.push_back({name, options.unit});
  return mapping_.find(name);
}

void Reader::missing(std::string_view name, std::string_view expected) {
  diagnostics_.add(mapping_.where(), fmt::format("missing key `{}`: expected {}", name, expected));
}

void SchemaWriter::add(std::string_view name, const RawNode& schema, const FieldOptions& options,
                       const RawNode* initial) {
  RawNode all = RawNode::mapping();
  if (std::string text = detail::comment_of(options); !text.empty()) {
    all.append("description", RawNode::text(std::move(text)));
  }
  for (std::size_t i = 0; i < schema.size(); ++i) all.append(schema.key(i), schema.child(i));
  if (initial) all.append("default", *initial);
  properties_.append(std::string(name), std::move(all));
}

RawNode SchemaWriter::take() && {
  RawNode schema = RawNode::mapping({{"type", RawNode::text("object")},
                                     {"additionalProperties", RawNode::boolean(false)},
                                     {"properties", std::move(properties_)}});
  if (required_.size() > 0) schema.append("required", std::move(required_));
  return schema;
}

std::string json_schema(const RawNode& body, std::string_view title, std::string_view id) {
  RawNode schema =
      RawNode::mapping({{"$schema", RawNode::text("http://json-schema.org/draft-07/schema#")},
                        {"$id", RawNode::text(std::string(id))},
                        {"title", RawNode::text(std::string(title))}});
  for (std::size_t i = 0; i < body.size(); ++i) schema.append(body.key(i), body.child(i));
  return codec::to_json(schema);
}

}  // namespace rave::codec
