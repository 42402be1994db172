// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>

namespace rave::base_testing {

/// Number of threads that the system still grants this process; negative: no limit.
inline std::atomic<int> threads_left{-1};

/// While it exists, the system grants no thread after the first `granted`, to any caller. One
/// object at a time.
class NoThreads {
 public:
  explicit NoThreads(int granted = 0) { threads_left = granted; }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;
  ~NoThreads() { threads_left = -1; }
};

}  // namespace rave::base_testing

// In the place of the system's, also for libraries and plug-ins: their calls find the symbol of the
// program first. A limit of the process (RLIMIT_NPROC) would not hold for root.
extern "C" [[gnu::used, gnu::visibility("default")]] inline int pthread_create(
    pthread_t* thread, const pthread_attr_t* attributes, void* (*body)(void*),
    void* argument) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto kCreate = reinterpret_cast<Create>(::dlsym(RTLD_NEXT, "pthread_create"));
  int left = rave::base_testing::threads_left;
  while (left > 0 && !rave::base_testing::threads_left.compare_exchange_weak(left, left - 1)) {
  }
  return left == 0 ? EAGAIN : kCreate(thread, attributes, body, argument);
}
