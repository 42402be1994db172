// SPDX-License-Identifier: Apache-2.0
#include "crash_report.hpp"

#include <sys/mman.h>
#include <ucontext.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>

#include "message.hpp"
#include "place_finder.hpp"

namespace rave::isolation {
namespace {

// Large enough for the search for a source line, which parses debug information on this stack.
// After a stack overflow it is the only stack that is left.
constexpr std::size_t kHandlerStackBytes = 512 * 1024;
// The search may itself loop in corrupted memory.
constexpr unsigned kHandlerLimitS = 1;

/// A signal handler gets no arguments of ours, so its data is global.
struct HandlerState {
  int socket = -1;
  PlaceFinder finder;
  std::atomic_flag busy = ATOMIC_FLAG_INIT;
  volatile std::sig_atomic_t signal = 0;
  volatile std::sig_atomic_t stack_overflow = 0;
};
HandlerState state;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

void send_crash(std::string_view place) {
  const auto signal = static_cast<std::uint32_t>(state.signal);
  const auto overflow = static_cast<std::uint32_t>(state.stack_overflow);
  // Only calls that POSIX permits in a signal handler: sendmsg() and _exit(). Nothing may allocate,
  // because the crash may have happened inside malloc().
  send_message(state.socket, {MessageKind::kCrash, signal, overflow}, place, false);
  ::_exit(128 + state.signal);
}

/// The search for the source line hangs or crashed itself: report without it.
void on_second_fault(int) { send_crash({}); }

bool is_stack_overflow(int number, const siginfo_t& info, const void* context) {
#if defined(__x86_64__)
  // A positive code comes from the kernel, that is, from a real access; others are signals sent by
  // a process.
  if (number != SIGSEGV || info.si_code <= 0) return false;
  const auto stack = static_cast<std::uintptr_t>(
      static_cast<const ucontext_t*>(context)->uc_mcontext.gregs[REG_RSP]);
  const auto fault = reinterpret_cast<std::uintptr_t>(info.si_addr);
  // An overflow faults near the stack pointer. The distance covers a large local array that the
  // first access skips.
  constexpr std::uintptr_t kNear = 256 * 1024;
  return fault < stack + kNear && stack < fault + kNear;
#else
  static_cast<void>(number), static_cast<void>(info), static_cast<void>(context);
  return false;
#endif
}

void guard_against_second_fault() {
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) {
    // SIGALRM ends a search that takes too long, in the same way as a second fault.
    std::signal(number, &on_second_fault);
  }
  sigset_t all;
  sigemptyset(&all);
  // The kernel blocks the signal whose handler runs. A second fault of the same kind would kill the
  // process without a report.
  ::pthread_sigmask(SIG_SETMASK, &all, nullptr);
  ::alarm(kHandlerLimitS);
}

void on_crash(int number, siginfo_t* info, void* context) {
  // Another thread is reporting and will end this process.
  if (state.busy.test_and_set()) ::pause();
  state.signal = number;
  state.stack_overflow = is_stack_overflow(number, *info, context) ? 1 : 0;
  guard_against_second_fault();
  send_crash(state.finder.find(context));
}

void on_where(int, siginfo_t*, void* context) {
  if (state.busy.test_and_set()) return;
  // The interrupted code may be about to read errno.
  const int error = errno;
  send_message(state.socket, {MessageKind::kWhere, 0, 0}, state.finder.find(context), false);
  errno = error;
  state.busy.clear();
}

}  // namespace

Status install_crash_report(int socket) {
  state.socket = socket;
  stack_t stack{};
  stack.ss_size = kHandlerStackBytes;
  stack.ss_sp =
      ::mmap(nullptr, stack.ss_size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (stack.ss_sp == MAP_FAILED || ::sigaltstack(&stack, nullptr) != 0) {
    return fail(ErrorCode::kIo, "cannot make a stack for signals: {}", std::strerror(errno));
  }
  struct sigaction action {};
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  action.sa_sigaction = &on_crash;
  for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    ::sigaction(number, &action, nullptr);
  }
  // The question of the host interrupts a program that may only be slow, and must not make its
  // system calls fail.
  action.sa_flags |= SA_RESTART;
  action.sa_sigaction = &on_where;
  ::sigaction(kWhereSignal, &action, nullptr);
  return {};
}

void learn_plugin(const void* function) { state.finder.learn(function); }

}  // namespace rave::isolation
