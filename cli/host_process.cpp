// SPDX-License-Identifier: Apache-2.0
#include "host_process.hpp"

#include <chrono>
#include <cmath>
#include <csignal>
#include <utility>

namespace rave::cli {

Result<HostProcess> HostProcess::start(std::vector<std::string> words) {
  process::ChildOptions options;
  options.words = std::move(words);
  // Ctrl-C is for this process, which tells the others in its own time.
  options.own_group = true;
  RAVE_TRY_ASSIGN(auto child, process::Child::start(options));
  return HostProcess(std::move(child));
}

HostProcess& HostProcess::operator=(HostProcess&& other) noexcept {
  if (this == &other) return *this;
  end();
  child_ = std::exchange(other.child_, {});
  return *this;
}

HostProcess::HostProcess(HostProcess&& other) noexcept : child_(std::exchange(other.child_, {})) {}

HostProcess::~HostProcess() { end(); }

std::optional<int> HostProcess::ended() { return wait(0); }

std::optional<int> HostProcess::wait(double longest_s) {
  const std::chrono::milliseconds longest(std::llround(std::ceil(longest_s * 1000)));
  const auto end = child_.wait(longest);
  if (!end) return std::nullopt;
  return end->signal ? -*end->signal : end->exit_code.value_or(0);
}

void HostProcess::interrupt() const noexcept { child_.signal(SIGINT); }

void HostProcess::end() noexcept {
  constexpr double kPatience_s = 2;
  if (child_.id() == 0 || ended()) return;
  child_.signal(SIGTERM);
  if (wait(kPatience_s)) return;
  child_.kill();
}

}  // namespace rave::cli
