// SPDX-License-Identifier: Apache-2.0
// Robots of one type are a group and share arrays; blocks are parts of groups. Robots of other
// hosts are in no group.
#include "roster.hpp"

#include <algorithm>

namespace rave::sim {

void Roster::lay_out(const EngineSpec& spec, LogSink* log) {
  const std::size_t count = spec.robots.size();
  logs.resize(count);
  group_index.assign(count, RobotId::kNone);
  member_index.resize(count);
  std::vector<std::uint32_t> group_of_type(spec.types.size(), RobotId::kNone);
  for (std::uint32_t r = 0; r < count; ++r) {
    if (local[r] == 0) continue;
    logs[r] = {log, fmt::format("robot {}", spec.robots[r].name)};
    std::uint32_t& index = group_of_type[spec.robots[r].type];
    if (index == RobotId::kNone) {
      index = static_cast<std::uint32_t>(groups.size());
      groups.emplace_back().type = &spec.types[spec.robots[r].type];
    }
    group_index[r] = index;
    member_index[r] = static_cast<std::uint32_t>(groups[index].members.size());
    // Ascending ids within a group, so that rows of a recording and blocks have neighbours side by
    // side.
    groups[index].members.emplace_back(r);
  }
  for (std::uint32_t g = 0; g < groups.size(); ++g) {
    const auto size = static_cast<std::uint32_t>(groups[g].members.size());
    for (std::uint32_t begin = 0; begin < size; begin += kMemberBlock) {
      blocks.push_back({g, begin, std::min(begin + kMemberBlock, size)});
    }
  }
}

}  // namespace rave::sim
