// SPDX-License-Identifier: Apache-2.0
#include "rave/request/edit.hpp"

#include "rave/codec/nodes.hpp"

namespace rave::codec {
namespace {

constexpr std::string_view kKey = "edit";

}  // namespace

void Codec<request::Edit>::read(const ReadContext& context, const RawNode& node,
                                request::Edit& value) {
  const RawNode* const edit = node.find(kKey);
  if (edit == nullptr || !edit->is_mapping() || node.size() > 1) {
    return context.error(node,
                         "expected `edit`, an object with one of `add_obstacle`, "
                         "`move_obstacle` and `remove_obstacle`");
  }
  auto read = config::read_edit(to_json_line(*edit), kKey);
  // Places within a line do not help.
  if (!read) return context.error(*edit, read.error().message);
  value.edit = *std::move(read);
}

RawNode Codec<request::Edit>::write(const request::Edit& value) {
  auto edit = parse_json(config::write_edit(value.edit));
  return RawNode::mapping({{kKey, edit ? *std::move(edit) : RawNode()}});
}

RawNode Codec<request::Edit>::schema(const FieldOptions& /*options*/) {
  return RawNode::mapping(
      {{"type", RawNode::text("object")},
       {"properties",
        RawNode::mapping({{kKey, RawNode::mapping({{"type", RawNode::text("object")}})}})},
       {"required", RawNode::sequence({RawNode::text(std::string(kKey))})}});
}

std::string Codec<request::Edit>::expectation(const FieldOptions& /*options*/) {
  return "a mapping with `edit`";
}

}  // namespace rave::codec
