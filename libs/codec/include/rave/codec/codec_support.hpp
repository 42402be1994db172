// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "rave/codec/codec_base.hpp"

// Shared by the codecs; internal to this library.
namespace rave::codec {
namespace detail {

void read_signed(const ReadContext& context, const RawNode& node, std::int64_t low,
                 std::int64_t high, std::int64_t& value);
void read_unsigned(const ReadContext& context, const RawNode& node, std::uint64_t high,
                   std::uint64_t& value);
RawNode number_schema(std::string_view type, const FieldOptions& options);
RawNode list_schema(RawNode items, const FieldOptions& options);
RawNode map_schema(RawNode values, const FieldOptions& options);
RawNode enum_schema(std::span<const std::string_view> names);
RawNode nullable_schema(RawNode schema);
/// The row of the table that the node names, or -1 after reporting.
int read_enum(const ReadContext& context, const RawNode& node,
              std::span<const std::string_view> names);
std::string enum_expectation(std::span<const std::string_view> names);
/// Whether the node is a list or mapping, as asked, of allowed length; reports if not.
bool check_collection(const ReadContext& context, const RawNode& node, RawNode::Kind kind,
                      std::string_view expected);
/// The options for elements: those of the list or map without its length limits.
FieldOptions element_options(const FieldOptions& options);
std::string item_label(const ReadContext& context, std::size_t index);

template <class E>
constexpr auto name_column() {
  constexpr auto table = enum_names(EnumTag<E>{});
  std::array<std::string_view, table.size()> names{};
  for (std::size_t i = 0; i < table.size(); ++i) names[i] = table[i].name;
  return names;
}

}  // namespace detail
}  // namespace rave::codec
