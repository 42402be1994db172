// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rave/base/descriptor.hpp"
#include "rave/base/result.hpp"

namespace rave::process {

/// How a child process starts. By default it inherits the files, signals and environment of this
/// process.
struct ChildOptions {
  struct File {
    int ours;    ///< Descriptor in this process; stays open.
    int theirs;  ///< Descriptor number in the child.
  };
  std::vector<std::string> words;  ///< The path of the executable, and its arguments.
  std::vector<File> files;         ///< Descriptors that the child receives.
  bool no_input = false;           ///< Its standard input is /dev/null.
  /// Descriptors with this number or above are closed in the child.
  std::optional<int> close_from;
  bool default_signals = false;  ///< All signals have their default action and none is blocked.
  /// A process group of its own: Ctrl-C in the terminal does not reach it.
  bool own_group = false;
  std::vector<std::string> variables;  ///< As `NAME=value`: added, in place of inherited ones.
  std::vector<std::string> without_variables;  ///< Environment variables that are removed.
};

/// How a child process ended.
struct ChildEnd {
  std::optional<int> exit_code;  ///< Set if it exited.
  std::optional<int> signal;     ///< Set if a signal ended it. Neither is set: another part of this
                                 ///< process has reaped it.
};

/// A child process. The destructor does not end it: a running child continues, and becomes a zombie
/// when it ends. One owner thread.
class Child {
 public:
  /// Starts a child. Errors: kNotFound (no such executable), kIo.
  [[nodiscard]] static Result<Child> start(const ChildOptions& options);
  Child() = default;  ///< No process.
  Child(Child&& other) noexcept
      : id_(std::exchange(other.id_, 0)), handle_(std::move(other.handle_)), end_(other.end_) {}
  Child& operator=(Child&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(handle_, other.handle_);
    std::swap(end_, other.end_);
    return *this;
  }
  ~Child() = default;

  /// The process id; 0: no process, or it has ended.
  [[nodiscard]] pid_t id() const noexcept { return id_; }
  void signal(int number) const noexcept;
  /// Waits for the end for at most `longest` (negative: without limit). Empty: still running.
  [[nodiscard]] std::optional<ChildEnd> wait(std::chrono::milliseconds longest);
  /// Kills the child (SIGKILL) unless it has ended, and waits for its end.
  ChildEnd kill();

 private:
  ChildEnd reap();

  pid_t id_ = 0;
  Descriptor handle_;
  ChildEnd end_;
};

}  // namespace rave::process
