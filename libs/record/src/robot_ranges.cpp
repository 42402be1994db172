// SPDX-License-Identifier: Apache-2.0
// Sets of robots as text, such as `0-9,12`: robots of a host mostly have numbers in a row.
#include "rave/record/robot_ranges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace rave::record {
namespace {

std::optional<std::uint32_t> number_of(std::string_view text) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

std::string robot_ranges(std::vector<std::uint32_t> robots) {
  std::ranges::sort(robots);
  std::string text;
  for (std::size_t i = 0; i < robots.size();) {
    std::size_t last = i;
    while (last + 1 < robots.size() && robots[last + 1] == robots[last] + 1) ++last;
    text += fmt::format("{}{}", text.empty() ? "" : ",", robots[i]);
    if (last > i) text += fmt::format("-{}", robots[last]);
    i = last + 1;
  }
  return text;
}

Result<std::vector<std::uint32_t>> parse_robot_ranges(std::string_view text, std::uint32_t count) {
  std::vector<std::uint32_t> robots;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view piece = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(piece.size() + 1, rest.size()));
    const std::size_t dash = piece.find('-');
    const auto first = number_of(piece.substr(0, dash));
    const auto last = dash == std::string_view::npos ? first : number_of(piece.substr(dash + 1));
    const bool ascends = robots.empty() || (first && *first > robots.back());
    if (!first || !last || *last < *first || *last >= count || !ascends) {
      return fail(ErrorCode::kParse, "`{}` are not ids of robots below {}", text, count);
    }
    for (std::uint32_t robot = *first; robot <= *last; ++robot) robots.push_back(robot);
  }
  return robots;
}

}  // namespace rave::record
