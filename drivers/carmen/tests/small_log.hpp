// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rave::carmen {

/// A corrected log of three scans of four beams: lines 3, 6 and 9. Behind the first scan an ODOM
/// row without a stamp, behind the second one that steps back by 0.2 s.
inline std::string small_log() {
  return "# CARMEN Logfile\n"
         "PARAM robot_frontlaser_offset 0.1 nohost 0\n"
         "FLASER 4 1.5 2 81.91 0.25 0.1 0.2 3.3 0.1 0.2 3.3 10.5 host 10.5\n"
         "ODOM 0.1 0.2 3.3 0 0 0 0 host 0\n"
         "NEFF 10\n"
         "FLASER 4 1.4 2 3 0.25 0.2 0.2 3.0 0.2 0.2 3.0 10.75 host 10.75\n"
         "ODOM 0.2 0.2 3.0 0.3 0.1 0 10.55 host 10.75\n"
         "ODOM 0.25 0.2 3.0 0.4 0.1 0 10.8 host 10.8\n"
         "FLASER 4 1.3 2 3 0.25 0.3 0.2 3.0 0.3 0.2 3.0 11 host 11\n";
}

/// The log with one text replaced by another.
inline std::string altered(const std::string& from, const std::string& to) {
  std::string log = small_log();
  const std::size_t at = log.find(from);
  return at == std::string::npos ? "not found" : log.replace(at, from.size(), to);
}

}  // namespace rave::carmen
