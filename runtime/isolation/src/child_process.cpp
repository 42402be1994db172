// SPDX-License-Identifier: Apache-2.0
#include "child_process.hpp"

#include <fmt/format.h>

#include "describe.hpp"
#include "message.hpp"

namespace rave::isolation {

Result<ChildProcess> ChildProcess::spawn(const std::vector<std::string>& arguments, int socket,
                                         int memory) {
  process::ChildOptions options;
  options.words = arguments;
  // The child finds its socket and memory at fixed descriptor numbers and inherits no others, so it
  // cannot reach files and sockets of the host.
  options.files = {{socket, kChildSocket}, {memory, kChildMemory}};
  options.no_input = true;
  options.close_from = kChildMemory + 1;
  // Signals that the host ignores or blocks would be inherited.
  options.default_signals = true;
  ChildProcess child;
  RAVE_TRY_ASSIGN(child.child_, process::Child::start(options));
  return child;
}

bool ChildProcess::wait_for_end(int milliseconds) {
  if (child_.id() == 0) return true;
  const auto end = child_.wait(std::chrono::milliseconds(milliseconds));
  if (end) note(*end);
  return end.has_value();
}

void ChildProcess::kill() {
  if (child_.id() != 0) note(child_.kill());
}

void ChildProcess::note(const process::ChildEnd& end) {
  if (end.exit_code) {
    how_ = fmt::format("exited with code {}", *end.exit_code);
  } else if (end.signal) {
    how_ = fmt::format("was killed by {}", signal_name(*end.signal));
  } else {
    how_ = "ended";  // Another part of the host has already reaped the child.
  }
}

}  // namespace rave::isolation
