// SPDX-License-Identifier: Apache-2.0
#include "rave/control/drive_watch.hpp"

namespace rave::runtime {

bool DriveWatch::driven(const std::string& robot, const std::string& by,
                        const request::Drive& drive, Time now, std::uint64_t page) {
  const auto [known, first] = drives_.try_emplace(robot);
  Drive& is = known->second;
  const bool other = first || is.by != by || is.asked != drive;
  is = {by, page, drive, now};
  return other;
}

bool DriveWatch::moves(const std::string& robot, const std::string& by, std::uint64_t page) const {
  const auto drive = drives_.find(robot);
  return drive != drives_.end() && drive->second.by == by && drive->second.page == page &&
         !drive->second.asked.stands();
}

std::vector<DriveWatch::Silent> DriveWatch::take_silent(Time now) {
  std::vector<Silent> silent;
  for (auto& [robot, drive] : drives_) {
    if (now - drive.renewed < kSilence || drive.asked.stands()) continue;
    drive.asked = {};
    silent.push_back({robot, drive.by, drive.page});
  }
  return silent;
}

}  // namespace rave::runtime
