// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave {

/// What a thread calls in a plug-in just now. All texts outlive the call.
struct CrashNote {
  const char* part = "";  ///< `program`, `sensor`, ...
  const char* driver = "";
  const char* robot = "";  ///< Its name.
  const char* last = "";   ///< The last of several robots that are called together, or `robot`.
};

namespace detail {
/// Of this thread; null outside of plug-ins. Read by the signal handler of the same thread.
extern constinit thread_local const CrashNote* crash_note;
}  // namespace detail

/// Keeps the note of this thread for as long as it lives. Costs two stores, so it may stand around
/// each call of a block of robots.
class CrashScope {
 public:
  explicit CrashScope(const CrashNote& note) noexcept : before_(detail::crash_note) {
    detail::crash_note = &note;
  }
  CrashScope(const CrashScope&) = delete;
  CrashScope& operator=(const CrashScope&) = delete;
  ~CrashScope() { detail::crash_note = before_; }

 private:
  const CrashNote* before_;
};

/// From now on a crash (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) within a CrashScope writes to the
/// standard error output whose code it was, and then ends the process as it would have. Signals
/// that somebody else handles already, as sanitizers do, are left alone. Once per process.
void install_crash_note() noexcept;

}  // namespace rave
