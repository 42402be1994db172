// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/config.hpp"
#include "rave/bus/request_book.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/control/run_control.hpp"
#include "rave/protocol/introduction.hpp"

namespace rave::manager {

/// Configuration of a manager that is the same in lock-step and in real time.
struct ManagerRunOptions {
  bus::BusConfig bus;
  lock_step::Identity identity;  ///< `host` is kNone; `real_time` says which kind of run it is.
  std::string scenario;          ///< Name of the scenario, for people.
  std::vector<config::PlannedHost> hosts;
  /// How long the run waits: in lock-step for a silent host, before `on_lost_host` applies; in real
  /// time for missing hosts at the start, from the arrival of the first.
  Duration host_timeout = from_seconds(10);
  /// Continue a run that has lost its manager; otherwise hosts whose run has begun are ignored.
  bool resume = false;
  /// By host, the command that restarts it after a loss; empty: it is restarted automatically.
  std::vector<std::string> commands;
  LogSink* log = nullptr;  ///< Not owned; must not be null.
  /// Called about ten times a second; true ends the run. May be empty.
  std::function<bool()> stopping;
  /// Requests to the run; not owned, may be null.
  runtime::RunControl* control = nullptr;
  /// Begins a request that arrived on the bus, in the calling thread; empty: such requests are
  /// refused.
  bus::BeginRequest begin_request;
};

}  // namespace rave::manager
