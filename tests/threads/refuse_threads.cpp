// SPDX-License-Identifier: Apache-2.0
// A system that grants a process no more threads, for a program that is started with this library
// in LD_PRELOAD: from the thread with the number in RAVE_REFUSE_THREAD on, counted from 1, it gets
// none. Only those of C++ count (std::thread, std::async): libraries such as Cyclone DDS get
// theirs. Says so once on standard error. Limits of the system do not hold for root.
#include <dlfcn.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace {

bool is_of_cpp(const void* caller) {
  Dl_info info{};
  return ::dladdr(caller, &info) != 0 && std::strstr(info.dli_fname, "libstdc++") != nullptr;
}

/// 0: all are granted.
int first_refused() {
  const char* const text = std::getenv("RAVE_REFUSE_THREAD");
  return text != nullptr ? std::atoi(text) : 0;
}

}  // namespace

extern "C" [[gnu::visibility("default")]] int pthread_create(pthread_t* thread,
                                                             const pthread_attr_t* attributes,
                                                             void* (*body)(void*),
                                                             void* argument) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto kCreate = reinterpret_cast<Create>(::dlsym(RTLD_NEXT, "pthread_create"));
  static const int kFirst = first_refused();
  static std::atomic<int> asked = 0;
  if (kFirst > 0 && is_of_cpp(__builtin_return_address(0)) && ++asked >= kFirst) {
    constexpr char kSaid[] = "REFUSED A THREAD\n";
    if (asked == kFirst) static_cast<void>(!::write(STDERR_FILENO, kSaid, sizeof kSaid - 1));
    return EAGAIN;
  }
  return kCreate(thread, attributes, body, argument);
}
