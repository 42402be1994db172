// SPDX-License-Identifier: Apache-2.0
// A line on standard error that says which plug-in was running when the process crashed.
#include "rave/base/crash_note.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstring>

namespace rave {
namespace detail {

// Per thread: a signal of a fault arrives in the thread that caused it.
constinit thread_local const CrashNote* crash_note = nullptr;

}  // namespace detail

namespace {

/// Builds a line without heap memory, which may be corrupt after a crash.
class Line {
 public:
  Line& operator<<(const char* text) noexcept {
    const std::size_t count = std::min(std::strlen(text), sizeof text_ - size_);
    std::memcpy(text_ + size_, text, count);
    size_ += count;
    return *this;
  }
  void write() const noexcept {
    std::size_t done = 0;
    while (done < size_) {
      const ssize_t count = ::write(STDERR_FILENO, text_ + done, size_ - done);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return;
      done += static_cast<std::size_t>(count);
    }
  }

 private:
  char text_[1024];
  std::size_t size_ = 0;
};

const char* name_of(int signal) noexcept {
  switch (signal) {
    case SIGSEGV:
      return "segmentation fault";
    case SIGBUS:
      return "bus error";
    case SIGFPE:
      return "arithmetic exception";
    case SIGILL:
      return "illegal instruction";
    default:
      return "abort";
  }
}

void on_crash(int signal) {
  // Only functions that are safe in a signal handler: no allocation, no lock, no stdio.
  if (const CrashNote* const note = detail::crash_note) {
    Line line;
    line << "\nrave: crashed (" << name_of(signal) << ") in " << note->part << " `" << note->driver;
    if (std::strcmp(note->robot, note->last) == 0) {
      line << "` of robot `" << note->robot << "`";
    } else {
      line << "` of one of the robots `" << note->robot << "` to `" << note->last << "`";
    }
    if (std::strcmp(note->part, "program") == 0) {
      line << "; with `isolate: true` in its robot file a crash costs that robot alone";
    }
    line << "\n";
    line.write();
  }
  // SA_RESETHAND has restored the default action.
  std::raise(signal);
}

}  // namespace

void install_crash_note() noexcept {
  // The alternative stack also serves stack overflows, at least in the first thread.
  alignas(16) static char stack[64 * 1024];
  stack_t alternative{};
  alternative.ss_sp = stack;
  alternative.ss_size = sizeof stack;
  stack_t present{};
  if (::sigaltstack(nullptr, &present) == 0 && (present.ss_flags & SS_DISABLE) != 0) {
    ::sigaltstack(&alternative, nullptr);
  }
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    struct sigaction action {};
    // A handler that was set before, such as that of a sanitizer, stays.
    if (::sigaction(signal, nullptr, &action) != 0 || action.sa_handler != SIG_DFL) continue;
    action.sa_handler = &on_crash;
    action.sa_flags = SA_ONSTACK | static_cast<int>(SA_RESETHAND);
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace rave
