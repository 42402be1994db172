// SPDX-License-Identifier: Apache-2.0
#include "carmen/no_return.hpp"

#include <algorithm>
#include <vector>

namespace rave::carmen {
namespace {

constexpr std::size_t kLeastRays = 10;
constexpr std::size_t kLeastShare = 1000;
constexpr std::size_t kFewLonger = 100;
constexpr std::size_t kMuchMore = 3;

}  // namespace

std::optional<NoReturn> find_no_return(std::span<const float> ranges_m, double range_max_m) {
  std::vector<float> sorted;
  sorted.reserve(ranges_m.size());
  for (const float range_m : ranges_m) {
    if (static_cast<double>(range_m) < range_max_m) sorted.push_back(range_m);
  }
  std::ranges::sort(sorted);
  std::vector<NoReturn> values;  // ascending
  for (const float range_m : sorted) {
    if (values.empty() || values.back().range_m != range_m) values.push_back({range_m, 0, 0});
    ++values.back().rays;
  }
  const std::size_t least = std::max(kLeastRays, ranges_m.size() / kLeastShare);
  std::size_t longer = 0;
  auto found = values.rbegin();
  for (; found != values.rend() && found->rays < least; ++found) longer += found->rays;
  if (found == values.rend() || longer * kFewLonger > found->rays) return std::nullopt;
  // Without far values any other one shows how many rays a wall has; a log of one value shows none.
  std::size_t most = 0;
  bool far = false;
  for (auto other = found + 1; other != values.rend(); ++other) {
    const bool is_far = other->range_m > found->range_m / 2;
    if (far && !is_far) break;
    far = far || is_far;
    most = std::max(most, other->rays);
  }
  if (most == 0 || found->rays < kMuchMore * most) return std::nullopt;
  return NoReturn{found->range_m, found->rays, ranges_m.size()};
}

}  // namespace rave::carmen
