// SPDX-License-Identifier: Apache-2.0
#include "rave/report/palette.hpp"

#include <algorithm>

namespace rave::report {

KindStyle palette_for(Kind kind) noexcept {
  // In the order of the kinds.
  static constexpr std::array<KindStyle, kAllKinds.size()> kStyles = {{
      {"#8c7a66", "mapped wall", "mapped walls"},
      {"#2b2b2b", "tube", "tubes"},
      {"#56b4e9", "virtual obstacle", "virtual obstacles"},
      {"#0072b2", "real robot", "real robots"},
      {"#8a93a3", "simulated robot", "simulated robots"},
      {"#882255", "hunter", "hunters"},
      {"#98a0ae", "part of a robot", "parts of robots"},
      {"#009e73", "sensor", "sensors"},
      {"#a8a8a8", "other body", "other bodies"},
  }};
  return kStyles[std::min(static_cast<std::size_t>(kind), kStyles.size() - 1)];
}

std::string_view robot_colour(std::size_t index) noexcept {
  static constexpr std::array<std::string_view, 5> kColours = {"#0072b2", "#d55e00", "#009e73",
                                                               "#cc79a7", "#e69f00"};
  return kColours[index % kColours.size()];
}

}  // namespace rave::report
