// SPDX-License-Identifier: Apache-2.0
#include "rave/base/markup.hpp"

#include "rave/base/word_table.hpp"

namespace rave {

std::string escaped_markup(std::string_view text) {
  constexpr WordTable<char, 5> kEntities = {
      {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}}};
  std::string escaped;
  for (const char c : text) {
    const std::string_view entity = kEntities.of(c);
    escaped += entity.empty() ? std::string_view(&c, 1) : entity;
  }
  return escaped;
}

}  // namespace rave
