// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "rave/bus/command_box.hpp"
#include "rave/bus/event_log.hpp"
#include "rave/bus/request_box.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/protocol/host_port.hpp"
#include "rave/protocol/host_results.hpp"
#include "rave/protocol/pulse.hpp"
#include "rave/protocol/robot_columns.hpp"
#include "rave/protocol/run_words.hpp"
#include "rave/protocol/step_messages.hpp"
#include "rave/sim/obstacle_history.hpp"

namespace rave::lock_step {

/// The state of a port; host_port_hear.cpp handles the processes of the run, host_port.cpp reports
/// and worlds.
struct HostPort::Impl {
  using Clock = std::chrono::steady_clock;

  Identity self;
  LogSink* log;
  bus::EventLog foreign;  ///< For messages caused by other processes; writes to `log`.
  std::unique_ptr<bus::Bus> bus;
  bus::Writer<bus::HostReport> reports;
  bus::Writer<bus::HostInfo> own_info;
  bus::Writer<bus::LastWorld> last_worlds;
  bus::Reader<bus::WorldStep> worlds;
  bus::Reader<bus::RunState> states;
  bus::Reader<bus::HostInfo> infos;
  std::unique_ptr<bus::RequestBox> requests;  ///< Null if other processes may not send requests.
  std::unique_ptr<bus::CommandBox> commands;  ///< The same for commands.
  bus::WaitSet waits;
  Pulse pulse;
  Roster roster;
  HostResultsSender host_results;
  bus::HostInfo introduced;  ///< What this process published about itself.
  Patience patience;
  ReportMessage message{};
  WorldMessage last_message{};
  /// Of the last world; with obstacles only if it brought them.
  sim::WorldStep coming{};  ///< The world being read, before its validity is known; a member to
                            ///< reuse its memory.
  sim::AuthorityState authority{};
  sim::ObstacleHistory obstacles{};                   ///< The obstacles before the last world.
  std::vector<sim::ObstacleChange> last_obstacles{};  ///< The changes of that world.
  bool has_world = false;
  std::uint64_t last_step = 0;  ///< The step of the last world.
  std::uint64_t epoch = 0;      ///< The epoch of the authority that answered last; 0: it is gone.
  std::uint64_t first_epoch = 0;
  bool changed_hands = false;      ///< Another authority than the first has answered.
  std::uint64_t manager = 0;       ///< The process of the manager; 0: none known.
  std::set<std::uint64_t> gone{};  ///< Processes that were lost and have not come back.
  RunWords words{};                ///< The announced states of the run, by process.
  Clock::time_point alone_since = Clock::now();  ///< Valid while there is no manager.
  bool overslept = false;  ///< The manager was lost after this process had been suspended.
  std::string told{};      ///< The last text in the log.
  Ending ending{};
  std::optional<Error> unfit{};
  std::optional<bus::Writer<bus::HostState>> states_out{};  ///< For monitors, together with
  std::optional<HostWord> host_word{};                      ///< this.
  RobotColumns columns{};
  ReportColumns reports_out{};
  Clock::time_point next_show{};

  void tell(LogLevel level, const std::string& text);
  void tell_foreign(LogLevel level, const std::string& text);
  void look_at_processes();
  void lose(std::uint64_t writer);
  void meet(const bus::HostInfo& info);
  void hear(const RunWord& word);
  void look_at_patience();
  void tell_word(std::uint64_t step);
  /// Begins what others ask, and answers what is done.
  void serve();
  Status send(const sim::HostReport& report, std::uint64_t hash, const sim::WorldStep& last);
  Status follow_obstacles(const sim::WorldStep& world, sim::AuthorityState& state);
  [[nodiscard]] bool take_world(const sim::HostReport& report, sim::WorldStep& world);

  bool over = false;
};

}  // namespace rave::lock_step
