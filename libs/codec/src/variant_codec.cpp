// SPDX-License-Identifier: Apache-2.0
// The part of the codec of variants that does not depend on their types.
#include "rave/codec/variant_codec.hpp"

namespace rave::codec::detail {

RawNode without_variant_key(const RawNode& node) {
  RawNode rest = node;
  rest.erase(kVariantKey);
  return rest;
}

int read_variant_name(const ReadContext& context, const RawNode& node,
                      std::span<const std::string_view> names) {
  if (!node.is_mapping()) {
    context.wrong(node, "a mapping");
    return -1;
  }
  const RawNode* const name = node.find(kVariantKey);
  if (name == nullptr) {
    context.error(
        node, fmt::format("missing key `{}`: expected {}", kVariantKey, enum_expectation(names)));
    return -1;
  }
  return read_enum({context.diagnostics, context.options, fmt::format("`{}`", kVariantKey)}, *name,
                   names);
}

RawNode with_variant_key(std::string_view name, RawNode node) {
  RawNode all = RawNode::mapping({{kVariantKey, RawNode::text(std::string(name))}});
  for (std::size_t i = 0; i < node.size(); ++i) {
    all.append(node.key(i), std::move(node.child(i)), node.comment(i));
  }
  return all;
}

RawNode named_schema(std::string_view name, RawNode schema) {
  RawNode* const properties = schema.find("properties");
  RawNode all = RawNode::mapping(
      {{kVariantKey, RawNode::mapping({{"const", RawNode::text(std::string(name))}})}});
  for (std::size_t i = 0; i < properties->size(); ++i) {
    all.append(properties->key(i), std::move(properties->child(i)));
  }
  *properties = std::move(all);
  RawNode* required = schema.find("required");
  if (required == nullptr) {
    schema.append("required", RawNode::sequence());
    required = schema.find("required");
  }
  required->push_back(RawNode::text(std::string(kVariantKey)));
  return schema;
}

RawNode any_schema(std::vector<RawNode> schemas) {
  return RawNode::mapping({{"oneOf", RawNode::sequence(std::move(schemas))}});
}

}  // namespace rave::codec::detail
