// SPDX-License-Identifier: Apache-2.0
// rave-keeper PROGRAM [ARGUMENT...]: runs a companion and leaves nothing of it behind. It ends the
// program when its standard input closes, which the kernel does for a starter that was killed. It
// adopts what the program started and left alone, and exits as the program did.
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <optional>

#include "rave/process/child.hpp"

namespace rave::launch {
namespace {

using Clock = std::chrono::steady_clock;

/// For the program to end by itself.
constexpr std::chrono::milliseconds kPatience{1500};

/// Signals that wake this process: a child has ended, or another process ends this one.
int wake_up_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int number : {SIGCHLD, SIGTERM, SIGINT, SIGHUP}) sigaddset(&signals, number);
  sigprocmask(SIG_BLOCK, &signals, nullptr);
  return ::signalfd(-1, &signals, SFD_CLOEXEC);
}

/// Sends a signal to all children of this process. How many there are.
int signal_children(int number) {
  std::ifstream children("/proc/self/task/" + std::to_string(::getpid()) + "/children");
  int count = 0;
  for (pid_t child = 0; children >> child; ++count) ::kill(child, number);
  return count;
}

class Keeper {
 public:
  Keeper(process::Child child, int signals)
      : child_(std::move(child)), group_(child_.id()), signals_(signals) {}

  /// Returns when the program and all that it left have ended.
  process::ChildEnd keep() {
    while (!ended()) {
      if (is_asked_to_end()) end();
    }
    // What it started lives in its group, or as a child of this process if it left the group.
    ::kill(-group_, SIGKILL);
    while (signal_children(SIGKILL) > 0) {
      if (::waitpid(-1, nullptr, 0) < 0 && errno == ECHILD) break;
    }
    return *end_;
  }

 private:
  bool ended() {
    if (!end_) end_ = child_.wait(std::chrono::milliseconds(0));
    return end_.has_value();
  }

  /// Waits for something to happen.
  bool is_asked_to_end() const {
    pollfd sources[] = {{STDIN_FILENO, POLLIN, 0}, {signals_, POLLIN, 0}};
    if (::poll(sources, 2, -1) < 0) return false;
    if (sources[0].revents != 0) return true;
    signalfd_siginfo info{};
    if (::read(signals_, &info, sizeof info) != static_cast<ssize_t>(sizeof info)) return false;
    if (info.ssi_signo != SIGCHLD) return true;
    reap_adopted();
    return false;
  }

  /// Those that the program left alone. The program itself is waited for by ended().
  void reap_adopted() const {
    siginfo_t info{};
    while (::waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid != 0 &&
           info.si_pid != group_) {
      ::waitpid(info.si_pid, nullptr, WNOHANG);
      info = {};
    }
  }

  void end() {
    ::kill(-group_, SIGTERM);
    end_ = child_.wait(kPatience);
    if (!end_) end_ = child_.kill();
  }

  process::Child child_;
  pid_t group_;
  int signals_;
  std::optional<process::ChildEnd> end_;
};

/// Ends this process by the same signal, so that its starter sees what happened.
void end_by(int number) {
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  std::signal(number, SIG_DFL);
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, number);
  sigprocmask(SIG_UNBLOCK, &signals, nullptr);
  ::raise(number);
}

int run(int argc, char** argv) {
  ::prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0);
  const int signals = wake_up_signals();
  process::ChildOptions options;
  options.words.assign(argv + 1, argv + argc);
  // Its standard input is that of this process: nothing comes there before the end.
  options.default_signals = true;
  options.own_group = true;
  options.close_from = STDERR_FILENO + 1;
  auto child = process::Child::start(options);
  if (!child) {
    std::fprintf(stderr, "%s\n", child.error().message.c_str());
    return 127;
  }
  const process::ChildEnd end = Keeper(*std::move(child), signals).keep();
  if (end.signal) end_by(*end.signal);
  return end.exit_code.value_or(1);
}

}  // namespace
}  // namespace rave::launch

int main(int argc, char** argv) { return rave::launch::run(argc, argv); }
