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
/// own; stops, releases and armings have another, so that nothing delays them or uses up the number
/// of requests that the manager accepts from one sender.
class ManagerRelay {
 public:
  /// `host`: the bus of the host, as it joins it.
  explicit ManagerRelay(bus::BusConfig host) : config_(std::move(host)) {}
  ManagerRelay(const ManagerRelay&) = delete;
  ManagerRelay& operator=(const ManagerRelay&) = delete;
  ~ManagerRelay() = default;

  /// Forwards a request. Any thread; does not wait. Errors of the future: kNotFound (no manager),
  /// those of BusRun::open() and BusRun::ask().
  [[nodiscard]] std::future<Result<Answer>> post(Request request);

 private:
  using Waiting = std::pair<Request, std::promise<Result<Answer>>>;

  /// One after the other, in the order in which they came.
  struct Lane {
    ~Lane();
    std::mutex mutex{};
    std::condition_variable_any changed{};
    std::deque<Waiting> waiting{};
    std::jthread thread{};
  };

  void work(Lane& lane, const std::stop_token& stop) const;

  bus::BusConfig config_;
  Lane holds_;
  Lane others_;
};

}  // namespace rave::control
