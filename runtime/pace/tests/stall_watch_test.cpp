// SPDX-License-Identifier: Apache-2.0
#include "rave/pace/stall_watch.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>

namespace rave::runtime {
namespace {

// Sanitizers need more of the address space than this leaves.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

class Told final : public LogSink {
 public:
  void write(LogLevel /*level*/, std::string_view /*source*/, std::string_view text) override {
    std::fprintf(stderr, "%.*s\n", static_cast<int>(text.size()), text.data());
  }
};

/// In a process that has no room for the stack of one more thread.
[[noreturn]] void watch_without_room() {
  const rlimit none{1, 1};
  if (::setrlimit(RLIMIT_AS, &none) != 0) std::exit(2);
  Told told;
  {
    StallWatch watch(&told);
    watch.step_begins(1);
    watch.step_ends();
  }
  std::exit(0);
}

TEST(StallWatch, WithoutAThreadWarnsAndTheRunGoesOn) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(watch_without_room(), ::testing::ExitedWithCode(0),
              "a step that does not end will not be reported");
}

#endif

}  // namespace
}  // namespace rave::runtime
