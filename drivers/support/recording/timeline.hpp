// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rave/base/time.hpp"

namespace rave::recording {

/// The samples of a player, grouped by stamp, in order.
template <class Record>
struct Timeline {
  struct Group {
    SimTime stamp;
    SimTime delivered;      ///< When a live run receives it; not before `stamp`.
    std::size_t first = 0;  ///< Index into `records`.
    /// Number of records; with std::byte as Record, the number of readings in its bytes.
    std::uint32_t count = 0;
  };
  std::vector<Record> records;
  std::vector<Group> groups;

  /// Begins the group of a stamp, which must be later than that of the last group.
  void begin(SimTime stamp) { groups.push_back({stamp, stamp, records.size(), 0}); }
  /// Adds a record to the last group.
  void add(const Record& record) {
    records.push_back(record);
    ++groups.back().count;
  }
  [[nodiscard]] std::uint32_t largest_group() const noexcept {
    std::uint32_t largest = 0;
    for (const Group& group : groups) largest = std::max(largest, group.count);
    return largest;
  }
};

/// The timeline of a state sensor, whose newest value holds, for a run from `start_ns` to `end_ns`
/// of the recording. Of the samples up to the start only the last is kept, with stamp 0, so that
/// there is a value from the first step on. `samples`: ascending in `t_ns`.
template <class Record, class Sample, class Convert>
[[nodiscard]] Timeline<Record> state_timeline(std::span<const Sample> samples,
                                              std::int64_t start_ns, std::int64_t end_ns,
                                              Convert convert) {
  Timeline<Record> timeline;
  for (const Sample& sample : samples) {
    if (sample.t_ns > end_ns) break;
    const SimTime stamp = std::max(SimTime{}, SimTime{sample.t_ns - start_ns});
    if (!timeline.groups.empty() && timeline.groups.back().stamp == stamp) {
      timeline.records.back() = convert(sample);
    } else {
      timeline.begin(stamp);
      timeline.add(convert(sample));
    }
  }
  return timeline;
}

}  // namespace rave::recording
