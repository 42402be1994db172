// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/process/descriptor.hpp"

namespace rave::process {

/// How a child begins. Without more it has the files, signals and environment of this process.
struct ChildOptions {
  struct File {
    int ours;    ///< Open here; stays open.
    int theirs;  ///< Its number there.
  };
  std::vector<std::string> words;              ///< The path of the executable, and its arguments.
  std::vector<File> files;                     ///< What it gets under which number.
  bool no_input = false;                       ///< Its standard input is empty.
  std::optional<int> close_from;               ///< It has no file of this number or above.
  bool default_signals = false;                ///< It blocks, ignores and handles none.
  bool own_group = false;                      ///< Ctrl-C in the terminal is not for it.
  std::vector<std::string> without_variables;  ///< Of the environment.
};

/// How a child ended.
struct ChildEnd {
  std::optional<int> exit_code;  ///< It ended by itself.
  std::optional<int> signal;     ///< A signal ended it. Neither: another part of the process knows.
};

/// A child process. Whoever destroys this before the child has ended leaves it running, and as a
/// zombie afterwards. One owner thread.
class Child {
 public:
  /// Errors: kNotFound (no such executable), kIo.
  [[nodiscard]] static Result<Child> start(const ChildOptions& options);
  Child() = default;  ///< None.
  Child(Child&& other) noexcept
      : id_(std::exchange(other.id_, 0)), handle_(std::move(other.handle_)), end_(other.end_) {}
  Child& operator=(Child&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(handle_, other.handle_);
    std::swap(end_, other.end_);
    return *this;
  }
  ~Child() = default;

  /// Its number; 0: there is none, or it has ended.
  [[nodiscard]] pid_t id() const noexcept { return id_; }
  void signal(int number) const noexcept;
  /// How it ended, if it has. Waits for that at most `longest`; below 0 without limit.
  [[nodiscard]] std::optional<ChildEnd> wait(std::chrono::milliseconds longest);
  /// Ends it at once, if it has not ended.
  ChildEnd kill();

 private:
  ChildEnd reap();

  pid_t id_ = 0;
  Descriptor handle_;
  ChildEnd end_;
};

}  // namespace rave::process
