// SPDX-License-Identifier: Apache-2.0
// The visitors that describe() of each struct goes through: reading, checking, writing, schema.
#include "rave/config/visitors.hpp"

#include <algorithm>
#include <cmath>

#include "known_keys.hpp"

namespace rave::config {
namespace {

bool has_non_finite(const RawNode& node) {
  if (const auto number = node.as_double()) return !std::isfinite(*number);
  return std::any_of(node.children().begin(), node.children().end(), has_non_finite);
}

}  // namespace

std::string unknown_key_message(std::string_view key, std::span<const KnownKey> known) {
  for (const KnownKey& candidate : known) {
    // `range` instead of `range_m` is the most likely mistake, and deserves the unit in the answer.
    if (!candidate.unit.empty() && candidate.name.size() > key.size() &&
        candidate.name.starts_with(key) && candidate.name[key.size()] == '_') {
      return fmt::format("unknown key `{}`: unit missing: expected `{}` ({})", key, candidate.name,
                         unit_words(candidate.unit));
    }
  }
  std::vector<std::string_view> names;
  for (const KnownKey& candidate : known) names.push_back(candidate.name);
  return fmt::format("unknown key `{}`{}", key, suggestion(key, names));
}

std::string field_comment(std::string_view doc, std::string_view unit) {
  if (unit.empty()) return std::string(doc);
  return doc.empty() ? fmt::format("[{}]", unit) : fmt::format("[{}] {}", unit, doc);
}

RawNode annotated_schema(const RawNode& schema, std::string_view doc, std::string_view unit,
                         const RawNode* initial) {
  RawNode all = RawNode::mapping();
  if (const std::string text = field_comment(doc, unit); !text.empty()) {
    all.append("description", RawNode::text(text));
  }
  for (std::size_t i = 0; i < schema.size(); ++i) all.append(schema.key(i), schema.child(i));
  // JSON has no infinity, so such a default is omitted.
  if (initial && !has_non_finite(*initial)) all.append("default", *initial);
  return all;
}

RawNode object_schema(RawNode properties, RawNode required) {
  RawNode schema = RawNode::mapping();
  schema.append("type", RawNode::text("object"));
  schema.append("additionalProperties", RawNode::boolean(false));
  schema.append("properties", std::move(properties));
  if (required.size() > 0) schema.append("required", std::move(required));
  return schema;
}

void ReadContext::wrong(const RawNode& node, std::string_view expected) const {
  error(node, fmt::format("found {}, expected {}", node.found_text(), expected));
}

void ReadContext::error(const RawNode& node, std::string message) const {
  if (!label.empty()) message = fmt::format("{}: {}", label, message);
  diagnostics.add(Error{ErrorCode::kParse, std::move(message), node.where()});
}

void CheckContext::report(std::string_view key, std::string message) {
  const RawNode* node = key.empty() ? nullptr : mapping_.find(key);
  diagnostics_.add(
      Error{ErrorCode::kParse, std::move(message), node ? node->where() : mapping_.where()});
}

const RawNode* Reader::take(std::string_view name, const FieldOptions& options) {
  // Keys that describe() asks for are the known ones; all others are errors in finish().
  known_.push_back({name, options.unit});
  return mapping_.find(name);
}

void Reader::missing(std::string_view name, std::string_view expected) {
  diagnostics_.add(Error{ErrorCode::kParse,
                         fmt::format("missing key `{}`: expected {}", name, expected),
                         mapping_.where()});
}

void Reader::finish() {
  std::vector<KnownKey> known;
  for (const Known& key : known_) known.push_back({key.name, key.unit});
  for (std::size_t i = 0; i < mapping_.size(); ++i) {
    const std::string& key = mapping_.key(i);
    const bool is_known = std::any_of(known.begin(), known.end(),
                                      [&key](const KnownKey& k) { return k.name == key; });
    if (is_known) continue;
    diagnostics_.add(
        Error{ErrorCode::kParse, unknown_key_message(key, known), mapping_.key_where(i)});
  }
}

std::string Writer::comment_of(const FieldOptions& options) {
  return field_comment(options.doc, options.unit);
}

void SchemaWriter::add(std::string_view name, const RawNode& schema, const FieldOptions& options,
                       const RawNode* initial) {
  properties_.append(std::string(name),
                     annotated_schema(schema, options.doc, options.unit, initial));
}

RawNode SchemaWriter::take() && {
  return object_schema(std::move(properties_), std::move(required_));
}

}  // namespace rave::config
