// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/reading_type.hpp"

#include "reading_table.hpp"

namespace rave {
namespace {

constexpr ReadingType kUnknown = {"unknown", {}, ReadingShape::kState, 0, {}, {}};

/// In the order of NumberFormat.
constexpr struct {
  std::string_view name;
  std::uint32_t bytes;
} kFormats[] = {{"int32", 4}, {"uint32", 4}, {"int64", 8}, {"float32", 4}, {"float64", 8}};

}  // namespace

const ReadingType& reading_type(ReadingKind kind) noexcept {
  const auto index = static_cast<std::size_t>(kind);
  return index < detail::kReadingKinds ? detail::kReadingTypes[index] : kUnknown;
}

std::string_view to_string(ReadingKind kind) noexcept { return reading_type(kind).name; }

std::uint32_t record_size(ReadingKind kind) noexcept { return reading_type(kind).record_bytes; }

std::string_view to_string(NumberFormat format) noexcept {
  return kFormats[static_cast<std::size_t>(format)].name;
}

std::uint32_t size_of(NumberFormat format) noexcept {
  return kFormats[static_cast<std::size_t>(format)].bytes;
}

}  // namespace rave
