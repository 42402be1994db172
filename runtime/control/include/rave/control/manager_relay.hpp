// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

#include "rave/base/result.hpp"
#include "rave/bus/config.hpp"
#include "rave/control/protocol.hpp"

namespace rave::control {

/// Forwards requests of a host to the Environment Manager of its run, for a GUI Server, which
/// exchanges no messages with the manager. Joins the bus with the first request, in a thread of its
/// own.
class ManagerRelay {
 public:
  /// `host`: the bus of the host, as it joins it.
  explicit ManagerRelay(bus::BusConfig host) : config_(std::move(host)) {}
  ManagerRelay(const ManagerRelay&) = delete;
  ManagerRelay& operator=(const ManagerRelay&) = delete;
  ~ManagerRelay();

  /// Forwards a request. Any thread; does not wait. Errors of the future: kNotFound (no manager),
  /// those of BusRun::open() and BusRun::ask().
  [[nodiscard]] std::future<Result<Answer>> post(Request request);

 private:
  using Waiting = std::pair<Request, std::promise<Result<Answer>>>;

  void work(const std::stop_token& stop);

  bus::BusConfig config_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Waiting> waiting_;
  std::jthread thread_;
};

}  // namespace rave::control
