// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>

#include "manager_endpoint.hpp"
#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/topics.hpp"
#include "rave/manager/manager_run_options.hpp"

namespace rave::manager {

/// The endpoint of a manager in real time. open() gives the real one; tests use others. Belongs to
/// one thread.
class LiveEndpoint {
 public:
  /// Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<LiveEndpoint>> open(const ManagerRunOptions& options);
  virtual ~LiveEndpoint() = default;

  /// Sleeps until a message arrives, the time has passed or `stop` is set.
  virtual void wait(Duration timeout, const std::stop_token& stop) = 0;
  /// The part that both kinds of run share.
  [[nodiscard]] virtual ManagerEndpoint& common() noexcept = 0;

  /// Requests of hosts for the time, and the answers.
  virtual void take_pings(const std::function<void(const bus::ClockPing&)>& visit) = 0;
  virtual void answer(bus::ClockPong& pong) = 0;
  /// Reports of hosts: poses of their robots.
  virtual void take_states(const std::function<void(const bus::HostState&)>& visit) = 0;
  virtual void refuse(const bus::HostState& state, std::string_view why) = 0;
  /// Sends the poses of all robots.
  virtual void send(bus::World& world) = 0;
  /// Errors: kIo.
  virtual Status send(bus::Obstacle& obstacle) = 0;

  /// Asks hosts for all obstacles that the previous manager had published. Errors: kState, kIo.
  virtual Status ask_for_handed() = 0;
  /// Calls `visit` for some of the answers; returns their number, 0 before the question.
  virtual std::size_t take_handed(const std::function<void(const bus::LastObstacle&)>& visit) = 0;
  virtual void end_handing() = 0;
};

}  // namespace rave::manager
