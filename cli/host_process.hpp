// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::cli {

/// A process that this one has started. Ended with it: by SIGTERM, and SIGKILL if that is not
/// enough.
class HostProcess {
 public:
  /// `words`: the executable and its arguments. Errors: kIo.
  [[nodiscard]] static Result<HostProcess> start(std::vector<std::string> words);
  HostProcess(HostProcess&& other) noexcept;
  HostProcess& operator=(HostProcess&& other) noexcept;
  ~HostProcess();

  /// How it ended: its exit code, or minus the signal that killed it; nothing while it runs.
  [[nodiscard]] std::optional<int> ended();
  /// Waits for its end for as long as told.
  [[nodiscard]] std::optional<int> wait(double longest_s);
  /// Asks it to end, as Ctrl-C does.
  void interrupt() const noexcept;
  [[nodiscard]] ::pid_t id() const noexcept { return process_; }

 private:
  explicit HostProcess(::pid_t process) : process_(process) {}
  void end() noexcept;

  ::pid_t process_ = -1;  ///< -1: there is none any more.
  std::optional<int> code_;
};

}  // namespace rave::cli
