// SPDX-License-Identifier: Apache-2.0
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <thread>

#include "arguments.hpp"
#include "error_text.hpp"
#include "rave/base/crash_note.hpp"

namespace rave::cli {
namespace {

/// The C library gives a thread that finds the heap locked a new one, up to eight for each core;
/// the memory of a process with many short waits then grows for hours and is never returned.
void limit_heaps() {
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  mallopt(M_ARENA_MAX, std::max(cores, 1));
}

}  // namespace
}  // namespace rave::cli

int main(int argc, char** argv) {
  rave::install_crash_note();
  rave::cli::limit_heaps();
  try {
    const int code = rave::cli::run_command_line(argc, argv);
    // Output that did not arrive, as on a full disk, is no success.
    if (code != rave::cli::kGood || std::ferror(stdout) == 0) return code;
    std::fprintf(stderr, "rave: cannot write to the standard output\n");
    return rave::cli::kNotGood;
  } catch (const std::exception& e) {
    // Out of memory, or a defect: say so rather than abort without a word.
    std::fprintf(stderr, "rave: unexpected failure: %s\n", e.what());
    return rave::cli::kNotGood;
  }
}
