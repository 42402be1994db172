// SPDX-License-Identifier: Apache-2.0
#include "memory.hpp"

#include <fstream>
#include <string>
#include <string_view>

namespace rave::swarm {
namespace {

/// A line `key: N kB` of /proc/self/status (proc(5)). getrusage() would tell the peak of the parent
/// too, whose memory a new process shares until exec().
double status_mb(std::string_view key) {
  std::ifstream file("/proc/self/status");
  std::string word;
  while (file >> word) {
    double kib = 0;
    if (word == key && file >> kib) return kib * 1024 / 1e6;
    file.ignore(4096, '\n');
  }
  return 0;
}

}  // namespace

double resident_mb() { return status_mb("VmRSS:"); }
double peak_resident_mb() { return status_mb("VmHWM:"); }

}  // namespace rave::swarm
