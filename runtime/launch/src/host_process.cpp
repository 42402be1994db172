// SPDX-License-Identifier: Apache-2.0
#include "host_process.hpp"

#include <csignal>
#include <utility>

namespace rave::launch {

Result<HostProcess> HostProcess::start(std::vector<std::string> words) {
  process::ChildOptions options;
  options.words = std::move(words);
  // Ctrl-C is for this process, which tells the others in its own time.
  options.own_group = true;
  RAVE_TRY_ASSIGN(auto child, process::Child::start(options));
  return HostProcess(std::move(child));
}

HostProcess::~HostProcess() {
  constexpr std::chrono::seconds kPatience{2};
  // Nothing is sent to one that has ended, or that this object has given away.
  child_.signal(SIGTERM);
  if (!child_.wait(kPatience)) child_.kill();
}

std::optional<int> HostProcess::wait(std::chrono::milliseconds longest) {
  const auto end = child_.wait(longest);
  if (!end) return std::nullopt;
  return end->signal ? -*end->signal : end->exit_code.value_or(0);
}

void HostProcess::interrupt() const noexcept { child_.signal(SIGINT); }

}  // namespace rave::launch
