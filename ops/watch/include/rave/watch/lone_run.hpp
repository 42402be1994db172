// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/result.hpp"
#include "rave/watch/process_row.hpp"
#include "rave/watch/run_model.hpp"
#include "rave/watch/run_view.hpp"

namespace rave::watch {

/// Monitors a run with one process of this user on this machine, through its control socket. One
/// owner thread.
class LoneRun {
 public:
  /// `name`: see control::find_run().
  explicit LoneRun(std::string name) : name_(std::move(name)) {}

  /// Queries the run. After its end it returns the last view, marked as gone. Errors: those of
  /// control::ask() except kNotFound; kState (its socket is gone and it was never seen).
  [[nodiscard]] Result<RunView> look(bool with_robots);

 private:
  [[nodiscard]] HostView process_row(const runtime::RunStatus& status);

  std::string name_;
  RunView last_;
  bool seen_ = false;
  Rate time_;
  ProcessRow row_;
};

}  // namespace rave::watch
