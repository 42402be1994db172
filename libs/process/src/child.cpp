// SPDX-License-Identifier: Apache-2.0
#include "rave/process/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <string_view>
#include <system_error>

namespace rave::process {
namespace {

std::string reason(int error) { return std::system_category().message(error); }

std::string_view name_of(std::string_view variable) {
  return variable.substr(0, variable.find('='));
}

std::vector<std::string> environment(const ChildOptions& options) {
  std::vector<std::string> all;
  // The later of two with one name is the one that counts.
  for (const std::string& added : options.variables) {
    std::erase_if(all, [&](const auto& other) { return name_of(other) == name_of(added); });
    all.push_back(added);
  }
  const std::size_t added = all.size();
  const auto& without = options.without_variables;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view name = name_of(*entry);
    const auto end = all.begin() + static_cast<std::ptrdiff_t>(added);
    if (std::ranges::find(without, name) != without.end()) continue;
    if (std::find_if(all.begin(), end, [name](const auto& a) { return name_of(a) == name; }) ==
        end) {
      all.emplace_back(*entry);
    }
  }
  return all;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// The actions of posix_spawn in the child before the program runs.
class SpawnPlan {
 public:
  explicit SpawnPlan(const ChildOptions& options) {
    ::posix_spawn_file_actions_init(&files_);
    ::posix_spawnattr_init(&attributes_);
    short flags = 0;
    if (options.no_input) {
      ::posix_spawn_file_actions_addopen(&files_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    }
    if (options.own_group) {
      ::posix_spawnattr_setpgroup(&attributes_, 0);
      flags |= POSIX_SPAWN_SETPGROUP;
    }
    if (options.default_signals) {
      sigset_t signals;
      sigfillset(&signals);
      ::posix_spawnattr_setsigdefault(&attributes_, &signals);
      sigemptyset(&signals);
      ::posix_spawnattr_setsigmask(&attributes_, &signals);
      flags |= POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK;
    }
    ::posix_spawnattr_setflags(&attributes_, flags);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  ~SpawnPlan() {
    ::posix_spawn_file_actions_destroy(&files_);
    ::posix_spawnattr_destroy(&attributes_);
  }

  /// Adds the descriptors to pass, and closes the rest. Returns 0 or errno.
  int add_files(const ChildOptions& options) {
    int above = STDERR_FILENO;
    for (const ChildOptions::File& file : options.files) above = std::max(above, file.theirs);
    for (const ChildOptions::File& file : options.files) {
      // Copies above all numbers of the child, so that no dup2 overwrites the source of another.
      Descriptor& copy = copies_.emplace_back(::fcntl(file.ours, F_DUPFD_CLOEXEC, above + 1));
      if (!copy) return errno;
      ::posix_spawn_file_actions_adddup2(&files_, copy.get(), file.theirs);
    }
    // Also those that libraries opened without O_CLOEXEC.
    if (options.close_from) {
      ::posix_spawn_file_actions_addclosefrom_np(&files_, *options.close_from);
    }
    return 0;
  }

  int run(const ChildOptions& options, pid_t& id) const {
    std::vector<std::string> words = options.words;
    std::vector<std::string> variables = environment(options);
    const std::vector<char*> argv = pointers_to(words);
    return ::posix_spawn(&id, argv[0], &files_, &attributes_, argv.data(),
                         pointers_to(variables).data());
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
  std::vector<Descriptor> copies_;
};

}  // namespace

Result<Child> Child::start(const ChildOptions& options) {
  if (options.words.empty())
    return fail(ErrorCode::kInvalidArgument, "expected a program to start");
  const std::string& name = options.words.front();
  SpawnPlan plan(options);
  Child child;
  int error = plan.add_files(options);
  if (error == 0) error = plan.run(options, child.id_);
  if (error != 0) {
    return fail(error == ENOENT ? ErrorCode::kNotFound : ErrorCode::kIo, "cannot start `{}`: {}",
                name, reason(error));
  }
  child.handle_ = Descriptor(static_cast<int>(::syscall(SYS_pidfd_open, child.id_, 0)));
  if (!child.handle_) {
    const int why = errno;
    ::kill(child.id_, SIGKILL);
    ::waitpid(child.id_, nullptr, 0);
    return fail(ErrorCode::kIo, "cannot watch the process of `{}`: {}", name, reason(why));
  }
  return child;
}

void Child::signal(int number) const noexcept {
  if (id_ != 0) ::syscall(SYS_pidfd_send_signal, handle_.get(), number, nullptr, 0);
}

std::optional<ChildEnd> Child::wait(std::chrono::milliseconds longest) {
  if (id_ == 0) return end_;
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + longest;
  pollfd gone{handle_.get(), POLLIN, 0};
  int ready = 0;
  // A signal to this process interrupts the wait.
  do {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
    const auto most = std::max(left, std::chrono::milliseconds(0)).count();
    ready = ::poll(&gone, 1, longest.count() < 0 ? -1 : static_cast<int>(most));
  } while (ready < 0 && errno == EINTR);
  if (ready <= 0) return std::nullopt;
  return reap();
}

ChildEnd Child::kill() {
  signal(SIGKILL);
  return reap();
}

ChildEnd Child::reap() {
  if (id_ == 0) return end_;
  siginfo_t info{};
  int result = 0;
  do {
    result = ::waitid(P_PIDFD, static_cast<id_t>(handle_.get()), &info, WEXITED);
  } while (result != 0 && errno == EINTR);
  // waitid() fails if this process reaps all its children itself.
  if (result == 0) (info.si_code == CLD_EXITED ? end_.exit_code : end_.signal) = info.si_status;
  id_ = 0;
  return end_;
}

}  // namespace rave::process
