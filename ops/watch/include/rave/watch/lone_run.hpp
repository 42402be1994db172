// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/result.hpp"
#include "rave/watch/run_model.hpp"
#include "rave/watch/run_view.hpp"

namespace rave::watch {

/// Looks on at a run of one process of this user on this machine, through its control socket. One
/// owner thread.
class LoneRun {
 public:
  /// `name`: as of control::find_run().
  explicit LoneRun(std::string name) : name_(std::move(name)) {}

  /// Asks the run. One that has ended meanwhile is shown as it was last, and gone. Errors: those of
  /// control::ask() but kNotFound; kState (it has no socket any more and was never seen).
  [[nodiscard]] Result<RunView> look(bool with_robots);

 private:
  void tell_process(HostView& host);

  std::string name_;
  RunView last_;
  bool seen_ = false;
  Rate time_;
  Rate cpu_;
};

}  // namespace rave::watch
