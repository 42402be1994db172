// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rave/bus/command_box.hpp"
#include "rave/bus/event_log.hpp"
#include "rave/bus/request_box.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/protocol/host_results.hpp"
#include "rave/protocol/host_word.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/protocol/pulse.hpp"
#include "rave/protocol/robot_columns.hpp"
#include "rave/protocol/roster.hpp"
#include "rave/protocol/run_words.hpp"

namespace rave::lock_step {

/// What a host sends and receives alike in lock-step and in real time: introductions, the words of
/// the manager, requests, results, and messages for monitors. Base of the state of HostPort and
/// HostLink, which say in the virtual functions what a message means for their run. One thread.
struct HostConnection {
  using Clock = std::chrono::steady_clock;

  HostConnection(Identity identity, LogSink* sink, bool has_manager)
      : self(std::move(identity)), log(sink), managed(has_manager) {}
  HostConnection(const HostConnection&) = delete;
  HostConnection& operator=(const HostConnection&) = delete;
  virtual ~HostConnection() = default;

  Identity self;
  LogSink* log;                ///< Not owned; may be null.
  bool managed;                ///< The run has an Environment Manager.
  bus::EventLog foreign{log};  ///< For messages caused by other processes.
  std::unique_ptr<bus::Bus> bus{};
  bus::Writer<bus::HostInfo> own_info{};
  bus::Reader<bus::HostInfo> infos{};
  bus::Reader<bus::RunState> runs{};  ///< Open if managed.
  HostResultsSender host_results{};   ///< Open if managed.
  bus::Writer<bus::HostState> states{};
  std::unique_ptr<bus::RequestBox> requests{};  ///< Null if others may not send requests.
  std::unique_ptr<bus::CommandBox> commands{};  ///< The same for commands.
  Pulse pulse{};
  Roster roster{};
  HostWord host_word{};
  bus::HostInfo introduced{};                    ///< What this process published about itself.
  bool begun = false;                            ///< This host has taken part in the run.
  std::uint64_t manager = 0;                     ///< The process of the manager; 0: none known.
  RunWords words{};                              ///< The announced states of the run, by process.
  Clock::time_point alone_since = Clock::now();  ///< Valid while there is no manager.
  std::optional<RunEnding> ending{};
  std::optional<Error> unfit{};
  std::string told{};  ///< The last text of tell_once() or tell_foreign().
  RobotColumns columns{};
  ReportColumns reports_out{};

  /// Joins the bus and opens what is common.
  Status open(const bus::BusConfig& config, bus::BeginRequest begin_request,
              bus::BeginCommand begin_command);
  /// Makes `waits` wake up for what is common, and introduces this process. From then on the
  /// manager answers, so all readers must exist.
  Status join(bus::WaitSet& waits);

  void tell(LogLevel level, const std::string& text) const;
  /// Logs a text once, until a different text follows.
  void tell_once(LogLevel level, const std::string& text);
  /// The same for texts caused by other processes.
  void tell_foreign(LogLevel level, const std::string& text);
  void tell_manager(const bus::HostInfo& info);

  /// Begins what others ask, and answers what is done.
  void serve();
  /// Handles introductions, words of the manager and losses.
  void look();
  /// Ends the run for this host if there has been no manager for `longest`; 0: no limit. A process
  /// started for a run that no longer exists must not wait forever. `why` ends the text.
  void look_at_patience(Duration longest, const char* why = "");
  /// Publishes the states of robots for monitors, and with `reports` the reported poses. `shift` is
  /// added to stamps.
  void publish(const sim::Engine& engine, std::span<const RobotId> robots, bool reports,
               Duration shift);
  /// Announces the end of the run after `step`, and sends the results to the manager.
  Status deliver(std::span<const std::byte> results, std::uint64_t step);

 private:
  /// Whether an earlier process of this host keeps its place whatever another one says.
  [[nodiscard]] virtual bool serves() const = 0;
  /// A manager of this run has introduced itself, perhaps again.
  virtual void meet_manager(const bus::HostInfo& info) = 0;
  virtual void hear(const RunWord& word) = 0;
  virtual void appear(std::uint64_t /*writer*/) {}
  virtual void lose(std::uint64_t writer) = 0;
  void meet(const bus::HostInfo& info);
};

}  // namespace rave::lock_step
