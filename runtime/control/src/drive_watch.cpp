// SPDX-License-Identifier: Apache-2.0
#include "rave/control/drive_watch.hpp"

namespace rave::runtime {

bool DriveWatch::driven(const std::string& robot, const std::string& by, double v_mps,
                        double w_radps, Time now, std::uint64_t page) {
  const auto [drive, first] = drives_.try_emplace(robot);
  Drive& is = drive->second;
  const bool other = first || is.by != by || is.v_mps != v_mps || is.w_radps != w_radps;
  is = {by, page, v_mps, w_radps, now};
  return other;
}

bool DriveWatch::moves(const std::string& robot, const std::string& by, std::uint64_t page) const {
  const auto drive = drives_.find(robot);
  return drive != drives_.end() && drive->second.by == by && drive->second.page == page &&
         drive->second.moves();
}

std::vector<DriveWatch::Silent> DriveWatch::take_silent(Time now) {
  std::vector<Silent> silent;
  for (auto& [robot, drive] : drives_) {
    if (now - drive.renewed < kSilence || !drive.moves()) continue;
    drive.v_mps = drive.w_radps = 0;
    silent.push_back({robot, drive.by, drive.page});
  }
  return silent;
}

}  // namespace rave::runtime
