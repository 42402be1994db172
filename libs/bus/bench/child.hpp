// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "rave/bus/bus.hpp"

namespace rave::bus::bench {

/// This program in another role, with its output to read.
struct Child {
  pid_t process = -1;
  FILE* output = nullptr;
};

[[nodiscard]] Child start(std::vector<std::string> words);
/// The next number that it prints; -1 if none comes.
[[nodiscard]] double number_from(const Child& child);

/// A bus of the benchmark's run; ends the program if there is none to be had.
[[nodiscard]] std::unique_ptr<Bus> join(const std::string& run, const char* name,
                                        int max_processes = 64);

template <class Known>
void wait_for(std::size_t count, const Known& known) {
  while (known() < count) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

}  // namespace rave::bus::bench
