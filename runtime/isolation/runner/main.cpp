// SPDX-License-Identifier: Apache-2.0
// Runs one robot program for a host that started this process; see isolated_program.hpp.

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <utility>

#include "crash_report.hpp"
#include "message.hpp"
#include "program_host.hpp"

// Sanitizers leave the signals to crash_report.cpp, which tells the host. Nothing calls these
// functions in a build without sanitizers.
// The sanitizers give the names. NOLINTBEGIN(readability-identifier-naming)
extern "C" __attribute__((visibility("default"))) const char* __asan_default_options();
extern "C" __attribute__((visibility("default"))) const char* __tsan_default_options();
extern "C" const char* __asan_default_options() {
  return "handle_segv=0:handle_sigbus=0:handle_sigfpe=0:handle_sigill=0:handle_abort=0:"
         "use_sigaltstack=0:allow_user_segv_handler=1";
}
extern "C" const char* __tsan_default_options() { return __asan_default_options(); }

namespace rave::isolation {
// NOLINTEND(readability-identifier-naming)

namespace {

pid_t host_id;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables): for a handler.

// A loop that calls nothing: see kWhereSignal. This process ignores a closed pipe (SIGPIPE).
#if defined(__SANITIZE_THREAD__)
constexpr int kHostEndSignal = SIGPIPE;
#else
constexpr int kHostEndSignal = SIGTERM;
#endif

/// The kernel sends it when the thread that started us ends, so look whether the host has.
void on_host_thread_end(int) {
  if (::getppid() != host_id) ::_exit(0);
}

void limit_this_process() {
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  // Without a limit an endless recursion would eat the machine's memory before it crashes.
  rlimit stack{};
  constexpr rlim_t kMaxStackBytes = 64UL * 1024 * 1024;
  ::getrlimit(RLIMIT_STACK, &stack);
  stack.rlim_cur = std::min(stack.rlim_cur, kMaxStackBytes);
  ::setrlimit(RLIMIT_STACK, &stack);
  // Those of the terminal are for the host, which ends us in its own order.
  for (const int number : {SIGINT, SIGHUP, SIGQUIT, SIGPIPE}) std::signal(number, SIG_IGN);
}

void end_with_host(pid_t host) {
  host_id = host;
  struct sigaction action {};
  action.sa_handler = &on_host_thread_end;
  action.sa_flags = SA_RESTART;
  ::sigaction(kHostEndSignal, &action, nullptr);
  ::prctl(PR_SET_PDEATHSIG, kHostEndSignal, 0, 0, 0);
  if (::getppid() != host) ::_exit(0);  // It ended before the line above.
}

Status run() {
  limit_this_process();
  // First of all, so that a crash in the constructors of the plug-in is reported, too.
  RAVE_TRY(install_crash_report(kChildSocket));
  RAVE_TRY_ASSIGN(SharedMemory memory, SharedMemory::map(Descriptor(kChildMemory)));
  RAVE_TRY_ASSIGN(const auto host, ProgramHost::create(std::move(memory), kChildSocket));
  end_with_host(static_cast<pid_t>(host->order().parent));
  if (host->start()) host->serve();
  return {};
}

bool started_by_host() {
  int type = 0;
  socklen_t size = sizeof type;
  return ::getsockopt(kChildSocket, SOL_SOCKET, SO_TYPE, &type, &size) == 0 &&
         type == SOCK_SEQPACKET;
}

}  // namespace
}  // namespace rave::isolation

int main() {
  using namespace rave::isolation;
  if (!started_by_host()) {
    std::fputs("rave-program-runner is started by rave for robots with `isolate: true`\n", stderr);
    return 2;
  }
  if (const rave::Status status = run(); !status) {
    const auto code = static_cast<std::uint32_t>(status.error().code);
    send_message(kChildSocket, {MessageKind::kStartFailed, code, 0}, status.error().text(), true);
    return 1;
  }
  return 0;
}
