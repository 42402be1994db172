// SPDX-License-Identifier: Apache-2.0
#include "rave/base/thread.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

namespace rave {
namespace {

TEST(StartThread, RunsWhatItIsGiven) {
  int done = 0;
  {
    std::jthread thread;
    ASSERT_TRUE(start_thread(thread, "a test", [&done] { ++done; }));
  }
  std::thread other;
  ASSERT_TRUE(start_thread(other, "a test", [&done] { ++done; }));
  other.join();
  EXPECT_EQ(done, 2);
  EXPECT_EQ(start_beside([] { return 7; }).get(), 7);
}

// Sanitizers need more of the address space than this leaves.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

std::vector<char> heap_room;

/// In a process that has no room for the stack of one more.
[[noreturn]] void ask_for_threads_without_room() {
  // Room on the heap for the texts of errors, which stays when it is given back.
  std::vector<char>(100'000).swap(heap_room);
  heap_room = {};
  const rlimit none{1, 1};
  if (::setrlimit(RLIMIT_AS, &none) != 0) std::exit(2);
  std::thread thread;
  const Status started = start_thread(thread, "a test", [] {});
  if (started || thread.joinable()) std::exit(3);
  std::jthread other;
  if (start_thread(other, "a test", [] {})) std::exit(4);
  if (start_beside([] { return 7; }).get() != 7) std::exit(5);
  std::fprintf(stderr, "%s\n", started.error().text().c_str());
  std::exit(0);
}

TEST(StartThread, ThatTheSystemDoesNotGrantIsAnErrorAndNoCrash) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(ask_for_threads_without_room(), ::testing::ExitedWithCode(0),
              "cannot start the thread of a test: ");
}

#endif

}  // namespace
}  // namespace rave
