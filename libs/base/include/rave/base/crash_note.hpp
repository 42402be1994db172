// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave {

/// The plug-in code that a thread is executing. All texts must outlive the call.
struct CrashNote {
  const char* part = "";  ///< `program`, `sensor`, ...
  const char* driver = "";
  const char* robot = "";  ///< Its name.
  /// The last robot of a block that is called together, or the same as `robot`.
  const char* last = "";
};

namespace detail {
/// The note of this thread; null outside of plug-ins. Read by the signal handler of the same
/// thread.
extern constinit thread_local const CrashNote* crash_note;
}  // namespace detail

/// Sets the crash note of this thread for the lifetime of the scope, then restores the previous
/// one. It costs two stores, so it may enclose each call of a block of robots.
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

/// Installs handlers of SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT. On a crash inside a CrashScope
/// they write the driver and robot of the scope to the standard error stream; the process then ends
/// as it would have without them. Signals that already have a handler, such as that of a sanitizer,
/// keep it. Call it once per process.
void install_crash_note() noexcept;

}  // namespace rave
