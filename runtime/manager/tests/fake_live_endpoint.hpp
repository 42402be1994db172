// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

#include "../src/live_endpoint.hpp"
#include "fake_endpoint.hpp"

namespace rave::manager {

/// Carries messages between a manager in real time and its hosts, in the thread of the manager.
class FakeLiveEndpoint final : public LiveEndpoint {
 public:
  void wait(Duration timeout, const std::stop_token& /*stop*/) override {
    const auto longest = std::chrono::nanoseconds(std::min<std::int64_t>(timeout.ns, 5'000'000));
    std::this_thread::sleep_for(longest);
    if (meanwhile) meanwhile();
    if (!common_.over()) return;
    for (const auto& [writer, host] : common_.hosts) common_.gone.push_back(writer);
  }
  ManagerEndpoint& common() noexcept override { return common_; }
  void take_pings(const std::function<void(const bus::ClockPing&)>& visit) override {
    for (const bus::ClockPing& ping : std::exchange(pings_, {})) visit(ping);
  }
  void answer(bus::ClockPong& pong) override { pongs.push_back(pong); }
  void take_states(const std::function<void(const bus::HostState&)>& /*visit*/) override {}
  void refuse(const bus::HostState& /*state*/, std::string_view /*why*/) override {}
  void send(bus::World& world) override { worlds.push_back(world.time_ns); }
  Status send(bus::Obstacle& /*obstacle*/) override { return {}; }
  Status ask_for_handed() override { return {}; }
  std::size_t take_handed(const std::function<void(const bus::LastObstacle&)>& /*visit*/) override {
    return 0;
  }
  void end_handing() override {}

  /// A process that serves a host, or wants to, asks for the time. `run_ns`: of the run that it is
  /// in; below 0: of none.
  void ping(std::uint64_t writer, std::uint32_t host, std::int64_t run_ns = -1) {
    common_.hosts[writer] = host;
    bus::ClockPing& ping = pings_.emplace_back();
    ping.writer = writer;
    ping.target = FakeEndpoint::kManager;
    ping.bound_ns = -1;
    ping.run_ns = run_ns;
  }
  [[nodiscard]] FakeEndpoint& endpoint() noexcept { return common_; }

  std::function<void()> meanwhile{};
  std::vector<bus::ClockPong> pongs;
  std::vector<std::int64_t> worlds;  ///< Their times, of the run.

 private:
  FakeEndpoint common_;
  std::vector<bus::ClockPing> pings_;
};

}  // namespace rave::manager
