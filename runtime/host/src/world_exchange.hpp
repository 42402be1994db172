// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/result.hpp"

namespace rave::runtime {

/// How the robots of this process come by the world that all robots share: what differs between the
/// kinds of run. The rest of the loop is go_through(). Belongs to the thread of the run.
class WorldExchange {
 public:
  virtual ~WorldExchange() = default;

  /// Before the first step. False: there is none for this process.
  [[nodiscard]] virtual Result<bool> begin() { return true; }
  /// Waits until the next step may be done, serves requests meanwhile, and sets RunSession::step.
  /// False: there is none; RunSession::stopped and `ended` say whether that was requested.
  [[nodiscard]] virtual Result<bool> await_turn() = 0;
  /// Does that step, with one look_back() at what is done.
  virtual Status step() = 0;
};

}  // namespace rave::runtime
