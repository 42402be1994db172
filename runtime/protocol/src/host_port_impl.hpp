// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "host_connection.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/protocol/host_port.hpp"
#include "rave/protocol/step_messages.hpp"
#include "rave/sim/obstacle_history.hpp"

namespace rave::lock_step {

/// The state of a port; host_port_hear.cpp handles the processes of the run, host_port.cpp reports
/// and worlds. `begun`: a world has arrived.
struct HostPort::Impl final : HostConnection {
  bus::Writer<bus::HostReport> reports{};
  bus::Writer<bus::LastWorld> last_worlds{};
  bus::Reader<bus::WorldStep> worlds{};
  bus::WaitSet waits{};  ///< Declared after the readers that it refers to.
  Patience patience;
  ReportMessage message{};
  WorldMessage last_message{};
  /// Of the last world; with obstacles only if it brought them.
  sim::WorldStep coming{};  ///< The world being read, before its validity is known; a member to
                            ///< reuse its memory.
  sim::AuthorityState authority{};
  sim::ObstacleHistory obstacles{};                   ///< The obstacles before the last world.
  std::vector<sim::ObstacleChange> last_obstacles{};  ///< The changes of that world.
  std::uint64_t last_step = 0;                        ///< The step of the last world.
  std::uint64_t epoch = 0;  ///< The epoch of the authority that answered last; 0: it is gone.
  std::uint64_t first_epoch = 0;
  bool changed_hands = false;      ///< Another authority than the first has answered.
  std::set<std::uint64_t> gone{};  ///< Processes that were lost and have not come back.
  bool overslept = false;          ///< The manager was lost after this process had been suspended.
  Clock::time_point next_show{};
  bool show_due = false;  ///< The states of the last step were not published.

  Impl(Identity identity, LogSink* sink, Patience its)
      : HostConnection(std::move(identity), sink, true), patience(its) {}
  Status open(const bus::BusConfig& config, bus::BeginRequest begin_request,
              bus::BeginCommand begin_command);
  bool serves() const override { return epoch != 0; }
  void meet_manager(const bus::HostInfo& info) override;
  void hear(const RunWord& word) override;
  void appear(std::uint64_t writer) override { gone.erase(writer); }
  void lose(std::uint64_t writer) override;
  void look_at_patience();
  void tell_word(std::uint64_t step);
  Status send(const sim::HostReport& report, std::uint64_t hash, const sim::WorldStep& last);
  Status follow_obstacles(const sim::WorldStep& world, sim::AuthorityState& state);
  [[nodiscard]] bool take_world(const sim::HostReport& report, sim::WorldStep& world);
};

}  // namespace rave::lock_step
