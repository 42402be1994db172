// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "rave/control/run_control.hpp"
#include "rave/watch/process_row.hpp"

namespace rave::gui_server {

/// The list of hosts of a run of one process, which is this one. No bus tells of it. One thread.
class OwnHost {
 public:
  using Clock = std::chrono::steady_clock;

  /// Makes the list anew, once a second at most. `name`: of the run. `step`: of its newest picture.
  /// Reads /proc.
  void look(Clock::time_point now, const std::string& name, std::uint64_t step,
            const runtime::RunStatus& status);
  /// As Source::hosts_json().
  [[nodiscard]] const std::string& json() const noexcept { return json_; }
  /// Changes with json(); 0: look() was never called.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }

 private:
  watch::ProcessRow row_;
  watch::Rate steps_;
  Clock::time_point next_{};
  std::string json_;
  std::uint64_t revision_ = 0;
};

}  // namespace rave::gui_server
