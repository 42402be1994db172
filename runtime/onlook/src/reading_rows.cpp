// SPDX-License-Identifier: Apache-2.0
#include "rave/onlook/reading_rows.hpp"

#include <algorithm>

#include "rave/robot/reading_type.hpp"

namespace rave::onlook {

std::uint32_t field_count(ReadingKind kind) noexcept {
  return static_cast<std::uint32_t>(reading_type(kind).columns.size());
}

std::uint32_t add_rows(ReadingKind kind, std::uint32_t count, std::span<const std::byte> records,
                       std::vector<float>& values) {
  const ReadingType& type = reading_type(kind);
  const std::size_t size = type.record_bytes;
  const std::size_t whole = size == 0 ? 0 : std::min<std::size_t>(count, records.size() / size);
  for (std::size_t i = 0; i < whole; ++i) {
    for (const ReadingField& field : type.columns) {
      with_number(field, records.data() + i * size,
                  [&values](auto number) { values.push_back(static_cast<float>(number)); });
    }
  }
  return static_cast<std::uint32_t>(whole);
}

}  // namespace rave::onlook
