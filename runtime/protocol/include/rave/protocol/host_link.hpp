// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/bus/clock_offset.hpp"
#include "rave/bus/command_box.hpp"
#include "rave/bus/config.hpp"
#include "rave/bus/request_book.hpp"
#include "rave/protocol/host_word.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/protocol/live_world.hpp"
#include "rave/protocol/pulse.hpp"
#include "rave/protocol/realities.hpp"
#include "rave/protocol/roster.hpp"
#include "rave/protocol/run_words.hpp"
#include "rave/sim/engine.hpp"

namespace rave::real_time {

/// A host's connection to a run in real time: it publishes the states and messages of its robots,
/// receives those of other robots, and synchronises to the time of the run. Belongs to one thread.
class HostLink {
 public:
  struct Options {
    bus::BusConfig bus;
    lock_step::Identity self;
    /// The run has an Environment Manager, whose clock is the clock of the run. Without one each
    /// host has its own time.
    bool managed = true;
    bool sees = true;   ///< A local robot needs the poses of others.
    bool talks = true;  ///< A local robot has communicators.
    /// By robot, the number of its host; for runs in which a robot has two sets of drivers. Empty:
    /// none has.
    std::vector<std::uint32_t> host_of = {};
    Duration world_period = from_seconds(0.1);  ///< Expected period of world messages.
    /// Before the start: without an Environment Manager for longer than this, the run ends for this
    /// host; 0: no limit.
    Duration manager_patience{};
    LogSink* log = nullptr;  ///< Not owned; may be null.
    /// Handles bus requests of others, inside calls of this object; may be empty.
    bus::BeginRequest begin_request = {};
    /// Begins the commands of others on the bus, likewise.
    bus::BeginCommand begin_command = {};
  };
  /// Joins the bus. `world` receives the data of other robots inside calls of this object; not
  /// owned. Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<HostLink>> open(Options options, LiveWorld& world);
  HostLink(const HostLink&) = delete;
  HostLink& operator=(const HostLink&) = delete;
  ~HostLink();

  /// The state of the run for monitors; not published before its scenario was set.
  [[nodiscard]] lock_step::HostWord& word() noexcept;
  /// The bus, for objects of this thread that end before it.
  [[nodiscard]] bus::Bus& bus() noexcept;
  /// The roster of this host's robots; nothing in the run waits for it.
  [[nodiscard]] lock_step::Roster& roster() noexcept;

  /// Waits for the time of the run and all obstacles; with `sees`, also for the first world. From
  /// then on zero() is constant. `stopping` is called ten times a second. False: `stopping`
  /// returned true. Logs what it waits for. Errors: kState (another process serves this host, or
  /// the manager is incompatible).
  [[nodiscard]] Result<bool> await_start(const std::function<bool()>& stopping);
  /// Time 0 of the run in the clock of this process. It does not change any more; later clock
  /// corrections apply only to the stamps of messages.
  [[nodiscard]] std::chrono::steady_clock::time_point zero() const noexcept;
  /// Poses of this host's robots in worlds before the start: where an earlier process of this host
  /// left them.
  [[nodiscard]] std::span<const RobotSight> starts() const noexcept;

  /// Receives messages until `due`, at least once even if that is past. Returns early if the run
  /// has ended.
  void listen_until(std::chrono::steady_clock::time_point due);
  /// Publishes the number of this host's real robots, after a hand-over.
  void count_real(std::uint32_t robots) noexcept;
  /// Publishes the states of robots as of the engine's last step; robots without a pose are
  /// omitted. No effect for an empty list. `reports`: include the reported poses, for a monitor
  /// that requests them.
  void tell(const sim::Engine& engine, std::span<const RobotId> robots, bool reports = false);
  /// Sends the messages of local robots in a step, each within its TalkLimit. Does not block.
  void send(const sim::SentPackets& sent);
  /// Robots that exceeded their TalkLimit since the last call; each once per run.
  [[nodiscard]] std::vector<RobotId> take_flooders();

  /// Publishes this host's missed deadlines, for monitors.
  void note_lateness(lock_step::Pulse::Lateness lateness);

  /// The last step showed local robots the obstacles up to LiveWorld::shown_revision(). The manager
  /// is notified if that has increased.
  void obstacles_shown();

  /// Sends the results of this host to the Environment Manager once, at the end of the run,
  /// and waits for the acknowledgement, ten seconds at most. No effect without a manager, or before
  /// the start. Errors: those of lock_step::HostResultsSender::send().
  [[nodiscard]] Status deliver(std::span<const std::byte> host_results);

  /// Changes of realities that hosts published since the last call; see Options::host_of.
  [[nodiscard]] std::vector<RobotReality> take_realities();

  /// Time since the last world message; 0 without `sees`.
  [[nodiscard]] Duration world_age() const;
  /// The offset of the manager's clock: that clock minus the local one; empty if unknown.
  [[nodiscard]] std::optional<bus::ClockReading> clock() const;
  /// The end of the run according to the manager; empty before.
  [[nodiscard]] const std::optional<lock_step::RunEnding>& ending() const noexcept;
  /// The number of local messages dropped because their robots exceeded the TalkLimit.
  [[nodiscard]] std::uint64_t withheld_packets() const noexcept;
  /// The number of local messages dropped because another process does not keep up.
  [[nodiscard]] std::uint64_t unsent_packets() const noexcept;
  /// The number of messages of other hosts' robots that were lost on the bus.
  [[nodiscard]] std::uint64_t lost_packets() const noexcept;
  /// The number of received worlds, and how often none arrived for longer than three periods and
  /// half a second.
  [[nodiscard]] std::uint64_t worlds() const noexcept;
  [[nodiscard]] std::uint64_t losses() const noexcept;

 private:
  struct Impl;
  explicit HostLink(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::real_time
