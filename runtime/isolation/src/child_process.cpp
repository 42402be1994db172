// SPDX-License-Identifier: Apache-2.0
#include "child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "describe.hpp"
#include "message.hpp"

namespace rave::isolation {
namespace {

/// What posix_spawn is to do in the child before the new program runs.
class SpawnPlan {
 public:
  SpawnPlan(int socket, int memory) {
    posix_spawn_file_actions_init(&files_);
    posix_spawnattr_init(&attributes_);
    posix_spawn_file_actions_addopen(&files_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files_, socket, kChildSocket);
    posix_spawn_file_actions_adddup2(&files_, memory, kChildMemory);
    // Also those that some other library opened without O_CLOEXEC.
    posix_spawn_file_actions_addclosefrom_np(&files_, kChildMemory + 1);
    sigset_t signals;
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes_, &signals);
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes_, &signals);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  int run(const std::vector<std::string>& arguments, pid_t& id) const {
    std::vector<char*> raw;
    for (const std::string& argument : arguments)
      raw.push_back(const_cast<char*>(argument.c_str()));
    raw.push_back(nullptr);
    return posix_spawn(&id, raw[0], &files_, &attributes_, raw.data(), environ);
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

/// A copy above the numbers that the child uses, so that one dup2 cannot overwrite the other's
/// source.
FileDescriptor above_child_files(int file) {
  return FileDescriptor(::fcntl(file, F_DUPFD_CLOEXEC, kChildMemory + 1));
}

}  // namespace

Result<ChildProcess> ChildProcess::spawn(const std::vector<std::string>& arguments, int socket,
                                         int memory) {
  const FileDescriptor socket_copy = above_child_files(socket);
  const FileDescriptor memory_copy = above_child_files(memory);
  if (socket_copy.get() < 0 || memory_copy.get() < 0) {
    return fail(ErrorCode::kIo, "cannot start `{}`: {}", arguments[0], std::strerror(errno));
  }
  ChildProcess child;
  const int error = SpawnPlan(socket_copy.get(), memory_copy.get()).run(arguments, child.id_);
  if (error != 0) {
    return fail(error == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo, "cannot start `{}`: {}",
                arguments[0], std::strerror(error));
  }
  child.handle_ = FileDescriptor(static_cast<int>(::syscall(SYS_pidfd_open, child.id_, 0)));
  if (child.handle_.get() < 0) {
    const int reason = errno;
    ::kill(child.id_, SIGKILL);
    ::waitpid(child.id_, nullptr, 0);
    return fail(ErrorCode::kIo, "cannot watch the process of `{}`: {}", arguments[0],
                std::strerror(reason));
  }
  return child;
}

void ChildProcess::signal(int number) const noexcept {
  if (id_ != 0) ::syscall(SYS_pidfd_send_signal, handle_.get(), number, nullptr, 0);
}

bool ChildProcess::wait_for_end(int milliseconds) {
  if (id_ == 0) return true;
  pollfd watch{handle_.get(), POLLIN, 0};
  int ready = 0;
  do {
    ready = ::poll(&watch, 1, milliseconds);
  } while (ready < 0 && errno == EINTR);
  if (ready <= 0) return false;
  reap();
  return true;
}

void ChildProcess::kill() {
  signal(SIGKILL);
  reap();
}

void ChildProcess::reap() {
  if (id_ == 0) return;
  siginfo_t info{};
  int result = 0;
  do {
    result = ::waitid(P_PIDFD, static_cast<id_t>(handle_.get()), &info, WEXITED);
  } while (result != 0 && errno == EINTR);
  if (result != 0) {
    how_ = "ended";  // The host reaps all its children itself.
  } else if (info.si_code == CLD_EXITED) {
    how_ = fmt::format("ended itself with exit code {}", info.si_status);
  } else {
    how_ = fmt::format("was ended by {}", signal_name(info.si_status));
  }
  id_ = 0;
}

}  // namespace rave::isolation
