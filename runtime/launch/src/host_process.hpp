// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/process/child.hpp"

namespace rave::launch {

/// A child process. The destructor ends it: by SIGTERM, then SIGKILL.
class HostProcess {
 public:
  /// `words`: the executable and its arguments. Errors: kIo.
  [[nodiscard]] static Result<HostProcess> start(std::vector<std::string> words);
  HostProcess(HostProcess&&) noexcept = default;
  HostProcess& operator=(HostProcess&&) noexcept = default;
  ~HostProcess();

  /// Waits for its end, at most for that long. Its exit code, or minus the signal that killed it;
  /// empty while it runs.
  [[nodiscard]] std::optional<int> wait(std::chrono::milliseconds longest);
  /// Asks it to end, as Ctrl-C does.
  void interrupt() const noexcept;

 private:
  explicit HostProcess(process::Child child) : child_(std::move(child)) {}

  process::Child child_;
};

}  // namespace rave::launch
