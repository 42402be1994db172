// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <memory>
#include <optional>

#include "rave/bus/writer.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/protocol/live_messages.hpp"

namespace rave::manager {

/// A process that says it is a host of the run.
class SpeakingHost {
 public:
  SpeakingHost(bus::BusConfig config, std::uint32_t number, const char* name) : number_(number) {
    config.participant = name;
    config.beside = true;
    bus_ = bus::Bus::open(config).value();
    info_.emplace(bus::Writer<bus::HostInfo>::create(*bus_).value());
    pings_.emplace(bus::Writer<bus::ClockPing>::create(*bus_).value());
    states_.emplace(bus::Writer<bus::HostState>::create(*bus_).value());
    bus::HostInfo info = lock_step::introduction({number, name, 1, 7, 9, true});
    EXPECT_TRUE(info_->write(info));
  }
  /// `run_ns`: of the run that it is in; below 0: of none.
  void ping(std::uint64_t manager, std::int64_t run_ns = 0) {
    bus::ClockPing ping{};
    ping.target = manager;
    ping.bound_ns = -1;
    ping.run_ns = run_ns;
    EXPECT_TRUE(pings_->write(ping));
  }
  /// Robots with these numbers are there, at this time of the run.
  void say(double x_m, std::initializer_list<std::uint32_t> robots, double at_s = 1) {
    columns_.clear();
    const SimTime stamp{from_seconds(at_s).ns};
    for (const std::uint32_t robot : robots) columns_.add({RobotId(robot), stamp, {x_m, 0, 0}, {}});
    bus::HostState state{};
    state.host = number_;
    state.step = 1;
    columns_.lend(state.resolved);
    EXPECT_TRUE(states_->write(state));
  }
  [[nodiscard]] std::uint64_t writer() const { return bus_->writer(); }
  /// The process of the manager; 0 until it is found.
  [[nodiscard]] std::uint64_t find_manager() {
    static_cast<void>(bus_->take_events());
    for (const bus::BusProcess& process : bus_->processes()) {
      if (process.name == "manager") return process.writer;
    }
    return 0;
  }

 private:
  std::uint32_t number_;
  std::unique_ptr<bus::Bus> bus_;
  std::optional<bus::Writer<bus::HostInfo>> info_;
  std::optional<bus::Writer<bus::ClockPing>> pings_;
  std::optional<bus::Writer<bus::HostState>> states_;
  real_time::RobotColumns columns_;
};

}  // namespace rave::manager
