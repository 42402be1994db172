// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "rave/base/result.hpp"
#include "rave/control/bus_run.hpp"
#include "rave/control/run_control.hpp"

namespace rave::gui_server {

/// Requests that are carried out one after the other, in the order in which they came, in a thread
/// with a bus of its own.
class RequestLane {
 public:
  using Answer = Result<std::string>;
  /// Carries out a request, in the thread of the lane.
  using Work = std::function<Answer(control::BusRun& bus)>;

  /// `config`: of the bus of the run. Errors: those of control::BusRun::open(), kIo (no thread).
  [[nodiscard]] static Result<std::unique_ptr<RequestLane>> open(const bus::BusConfig& config);
  RequestLane(const RequestLane&) = delete;
  RequestLane& operator=(const RequestLane&) = delete;
  /// What waits is answered with an error.
  ~RequestLane();

  /// Any thread; does not wait.
  [[nodiscard]] std::future<Answer> queue(Work work);

 private:
  explicit RequestLane(std::unique_ptr<control::BusRun> bus) : bus_(std::move(bus)) {}

  void work(const std::stop_token& stop);

  std::unique_ptr<control::BusRun> bus_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<std::pair<Work, std::promise<Answer>>> waiting_;
  std::jthread thread_;
};

}  // namespace rave::gui_server
