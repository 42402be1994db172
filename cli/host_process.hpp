// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/process/child.hpp"

namespace rave::cli {

/// A child process. The destructor ends it: by SIGTERM, then SIGKILL.
class HostProcess {
 public:
  /// `words`: the executable and its arguments. Errors: kIo.
  [[nodiscard]] static Result<HostProcess> start(std::vector<std::string> words);
  HostProcess(HostProcess&& other) noexcept;
  HostProcess& operator=(HostProcess&& other) noexcept;
  ~HostProcess();

  /// Its exit code, or minus the signal that killed it; empty while it runs.
  [[nodiscard]] std::optional<int> ended();
  /// Waits for its end, at most for that long.
  [[nodiscard]] std::optional<int> wait(double longest_s);
  /// Asks it to end, as Ctrl-C does.
  void interrupt() const noexcept;
  /// 0 once it has ended.
  [[nodiscard]] ::pid_t id() const noexcept { return child_.id(); }

 private:
  explicit HostProcess(process::Child child) : child_(std::move(child)) {}
  void end() noexcept;

  process::Child child_;
};

}  // namespace rave::cli
