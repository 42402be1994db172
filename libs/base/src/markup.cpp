// SPDX-License-Identifier: Apache-2.0
#include "rave/base/markup.hpp"

#include "rave/base/word_table.hpp"

namespace rave {

std::string escaped_markup(std::string_view text) {
  constexpr WordTable<char, 5> kEscapes = {
      {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&#39;", '\''}}};
  std::string out;
  for (const char& c : text) out += kEscapes.of(c, {&c, 1});
  return out;
}

}  // namespace rave
