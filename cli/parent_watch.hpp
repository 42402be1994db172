// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <thread>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/config.hpp"
#include "rave/control/run_control.hpp"

namespace rave::cli {

/// Ends a host whose starter was killed, unless another Environment Manager has taken its place: in
/// real time a host would continue by itself for ever. One owner thread.
class ParentWatch {
 public:
  /// `bus`: of the host. `patience`: from the end of the starter on. `control` and `log` outlive
  /// this object. Error: kIo (no thread).
  [[nodiscard]] Status start(const bus::BusConfig& bus, Duration patience,
                             runtime::RunControl& control, LogSink& log);

 private:
  std::jthread thread_;
};

}  // namespace rave::cli
