// SPDX-License-Identifier: Apache-2.0
#include "host_process.hpp"

#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <utility>

extern char** environ;

namespace rave::cli {

Result<HostProcess> HostProcess::start(std::vector<std::string> words) {
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawnattr_t attributes;
  ::posix_spawnattr_init(&attributes);
  // A group of its own: Ctrl-C is for this process, which tells the others in its own time.
  ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  ::posix_spawnattr_setpgroup(&attributes, 0);
  ::pid_t process = -1;
  const int error = ::posix_spawn(&process, argv[0], nullptr, &attributes, argv.data(), environ);
  ::posix_spawnattr_destroy(&attributes);
  if (error != 0) {
    return fail(ErrorCode::kIo, "cannot start `{}`: {}", words.front(), std::strerror(error));
  }
  return HostProcess(process);
}

HostProcess::HostProcess(HostProcess&& other) noexcept
    : process_(std::exchange(other.process_, -1)), code_(other.code_) {}

HostProcess& HostProcess::operator=(HostProcess&& other) noexcept {
  if (this == &other) return *this;
  end();
  process_ = std::exchange(other.process_, -1);
  code_ = other.code_;
  return *this;
}

HostProcess::~HostProcess() { end(); }

std::optional<int> HostProcess::ended() {
  if (process_ < 0) return code_;
  int status = 0;
  if (::waitpid(process_, &status, WNOHANG) != process_) return std::nullopt;
  process_ = -1;
  code_ = WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
  return code_;
}

std::optional<int> HostProcess::wait(double longest_s) {
  if (process_ < 0) return code_;
  using Clock = std::chrono::steady_clock;
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const auto end = Clock::now() + std::chrono::duration<double>(longest_s);
  const int handle = static_cast<int>(::syscall(SYS_pidfd_open, process_, 0));
  if (handle < 0) return ended();
  ::pollfd gone{handle, POLLIN, 0};
  int ready = 0;
  // A signal of this process cuts the waiting short.
  do {
    const double left_ms = Milliseconds(end - Clock::now()).count();
    ready = ::poll(&gone, 1, static_cast<int>(std::max(0.0, std::ceil(left_ms))));
  } while (ready < 0 && errno == EINTR);
  ::close(handle);
  return ended();
}

void HostProcess::interrupt() const noexcept {
  if (process_ > 0) ::kill(process_, SIGINT);
}

void HostProcess::end() noexcept {
  constexpr double kPatience_s = 2;
  if (ended()) return;
  if (process_ < 0) return;
  ::kill(process_, SIGTERM);
  if (wait(kPatience_s)) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
}

}  // namespace rave::cli
