// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/process/child.hpp"

namespace rave::isolation {

/// The process of an isolated program.
class ChildProcess {
 public:
  /// Starts `arguments[0]` with `socket` and `memory` as kChildSocket and kChildMemory, standard
  /// output and error inherited, standard input empty and everything else closed.
  /// Errors: kNotFound, kIo.
  [[nodiscard]] static Result<ChildProcess> spawn(const std::vector<std::string>& arguments,
                                                  int socket, int memory);
  ChildProcess() = default;
  ChildProcess(ChildProcess&&) noexcept = default;
  ChildProcess& operator=(ChildProcess&&) noexcept = default;
  /// The process must have ended before; see wait_for_end() and kill().
  ~ChildProcess() = default;

  /// 0 once the process has ended.
  [[nodiscard]] pid_t id() const noexcept { return child_.id(); }
  void signal(int number) const noexcept { child_.signal(number); }
  /// Waits at most `milliseconds`; true if the process has ended, then how() describes it.
  bool wait_for_end(int milliseconds);
  void kill();
  /// For example `exited with code 3` or `was killed by segmentation fault`.
  [[nodiscard]] const std::string& how() const noexcept { return how_; }

 private:
  void note(const process::ChildEnd& end);

  process::Child child_;
  std::string how_;
};

}  // namespace rave::isolation
