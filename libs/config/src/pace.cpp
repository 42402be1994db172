// SPDX-License-Identifier: Apache-2.0
#include "rave/config/pace.hpp"

#include <cmath>

#include "rave/codec/numbers.hpp"
#include "rave/config/described.hpp"

namespace rave::config {

Result<Pace> parse_pace(std::string_view text) {
  if (text == "max") return Pace{};
  if (text == "realtime") return Pace{1};
  if (text.ends_with('x')) {
    const auto factor = RawNode::plain(std::string(text.substr(0, text.size() - 1))).as_double();
    if (factor && std::isfinite(*factor) && *factor > 0) return Pace{*factor};
  }
  return fail(ErrorCode::kParse,
              "found the text \"{}\", expected `max`, `realtime` or a positive number followed by "
              "`x`, such as `10x`",
              text);
}

std::string to_string(const Pace& pace) {
  if (pace.is_max()) return "max";
  return pace.factor == 1 ? "realtime" : codec::number_text(pace.factor) + "x";
}

}  // namespace rave::config
