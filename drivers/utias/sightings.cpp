// SPDX-License-Identifier: Apache-2.0
#include "utias/sightings.hpp"

#include <algorithm>
#include <utility>

#include "rave/base/check.hpp"

namespace rave::utias {

SightingLog::SightingLog(std::vector<Sighting> sightings) : sightings_(std::move(sightings)) {
  for (std::size_t i = 0; i < sightings_.size(); ++i) {
    RAVE_CHECK(i == 0 || sightings_[i - 1].t_ns <= sightings_[i].t_ns);
    // One image has one stamp, so equal stamps are one group.
    if (i == 0 || sightings_[i - 1].t_ns != sightings_[i].t_ns) group_begins_.push_back(i);
  }
}

std::span<const Sighting> SightingLog::group(std::size_t index) const noexcept {
  RAVE_CHECK(index < group_begins_.size());
  const std::size_t begin = group_begins_[index];
  const std::size_t end =
      index + 1 < group_begins_.size() ? group_begins_[index + 1] : sightings_.size();
  return std::span(sightings_).subspan(begin, end - begin);
}

}  // namespace rave::utias
