// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "rave/config/fields.hpp"

namespace rave::config {

/// A mapping without its comments and without what is not set, as people write it.
inline RawNode brief(const RawNode& full) {
  if (!full.is_mapping()) return full;
  RawNode out = RawNode::mapping();
  for (std::size_t i = 0; i < full.size(); ++i) {
    const RawNode& value = full.child(i);
    if (value.is_null()) continue;
    // The values of parameters are the user's: there, null may be one.
    out.append(full.key(i), full.key(i) == "set" ? value : brief(value));
  }
  return out;
}

/// A list of described structs in brief, for tens of thousands of obstacles or changes: with all
/// keys and their comments the text would be longer than one that is read.
template <class T>
RawNode brief_list(const std::vector<T>& items) {
  std::vector<RawNode> nodes;
  nodes.reserve(items.size());
  for (const T& item : items) nodes.push_back(brief(codec::write_node(item)));
  return RawNode::sequence(std::move(nodes));
}

}  // namespace rave::config
