// SPDX-License-Identifier: Apache-2.0
#include "rave/control/drive_watch.hpp"

namespace rave::runtime {

bool DriveWatch::driven(const std::string& robot, const std::string& by, double v_mps,
                        double w_radps, Time now) {
  const auto [drive, first] = drives_.try_emplace(robot);
  Drive& is = drive->second;
  const bool other = first || is.by != by || is.v_mps != v_mps || is.w_radps != w_radps;
  is = {by, v_mps, w_radps, now};
  return other;
}

std::vector<DriveWatch::Silent> DriveWatch::take_silent(Time now) {
  std::vector<Silent> silent;
  for (auto& [robot, drive] : drives_) {
    if (now - drive.renewed < kSilence || (drive.v_mps == 0 && drive.w_radps == 0)) continue;
    drive.v_mps = drive.w_radps = 0;
    silent.push_back({robot, drive.by});
  }
  return silent;
}

}  // namespace rave::runtime
