// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/bus.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/run_id.hpp"
#include "rave/bus/sequence.hpp"

namespace rave::cli_test {

/// Somebody who looks on at a run in real time, from this process.
class LiveListener {
 public:
  /// `apart`: the words that keep a test's run apart.
  [[nodiscard]] static Result<std::unique_ptr<LiveListener>> open(
      const bus::RunId& run, const std::vector<std::string>& apart);

  /// Takes in what has come.
  void listen();

  struct Place {
    double x_m = 0;
    double y_m = 0;
    std::int64_t stamp_ns = 0;
  };
  struct WorldTime {
    std::uint64_t number = 0;
    std::uint64_t manager = 0;
    std::int64_t time_ns = 0;
  };
  std::map<std::uint32_t, Place> places;  ///< By robot, as the last world shows.
  std::set<std::uint32_t> stale;          ///< In the last world.
  std::vector<WorldTime> worlds;          ///< Each that came.
  std::map<std::uint32_t, std::vector<std::int64_t>> stamps_ns;  ///< By robot, as its host said.
  std::optional<rave_wire_RunState> run;             ///< Its last state, without what it points to.
  std::map<std::string, rave_wire_HostSight> hosts;  ///< In it, by name.

 private:
  LiveListener(std::unique_ptr<bus::Bus> bus, bus::Reader<bus::World> worlds_in,
               bus::Reader<bus::HostState> states, bus::Reader<bus::RunState> runs)
      : bus_(std::move(bus)),
        worlds_(std::move(worlds_in)),
        states_(std::move(states)),
        runs_(std::move(runs)) {}

  std::unique_ptr<bus::Bus> bus_;
  bus::Reader<bus::World> worlds_;
  bus::Reader<bus::HostState> states_;
  bus::Reader<bus::RunState> runs_;
};

}  // namespace rave::cli_test
