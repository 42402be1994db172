// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <poll.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace rave::bus::testing {

/// How the other process of a test speaks with it, see PeerProcess: a line that the test waits for.
inline void say(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

/// Whether the test has closed its end; waits at most `wait_ms` for that.
inline bool ended(int wait_ms) {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  if (::poll(&input, 1, wait_ms) <= 0) return false;
  char byte = 0;
  return ::read(STDIN_FILENO, &byte, 1) <= 0;
}

}  // namespace rave::bus::testing
