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
#include "rave/manager/live_manager.hpp"

namespace rave::manager {

/// What the manager of a run in real time does with the bus. Tests play others than open() gives.
/// Belongs to one thread.
class LiveEndpoint {
 public:
  /// Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<LiveEndpoint>> open(
      const LiveManagerOptions& options);
  virtual ~LiveEndpoint() = default;

  /// Sleeps until something has come, the time is over or `stop` is set.
  virtual void wait(Duration timeout, const std::stop_token& stop) = 0;
  /// What it has in common with the managers of other runs.
  [[nodiscard]] virtual ManagerEndpoint& common() noexcept = 0;

  /// Hosts ask for the time,
  virtual void take_pings(const std::function<void(const bus::ClockPing&)>& visit) = 0;
  virtual void answer(bus::ClockPong& pong) = 0;
  /// say where their robots are,
  virtual void take_states(const std::function<void(const bus::HostState&)>& visit) = 0;
  virtual void refuse(const bus::HostState& state, std::string_view why) = 0;
  /// and are told where all are.
  virtual void send(bus::World& world) = 0;
  /// Errors: kIo.
  virtual Status send(bus::Obstacle& obstacle) = 0;

  /// Asks for all obstacles that hosts keep of the manager before. Errors: kState, kIo.
  virtual Status ask_for_handed() = 0;
  /// Calls `visit` for some of those that have come; returns for how many. 0 before that was asked.
  virtual std::size_t take_handed(const std::function<void(const bus::LastObstacle&)>& visit) = 0;
  virtual void end_handing() = 0;
};

}  // namespace rave::manager
