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
#include "rave/bus/wish_book.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/protocol/live_world.hpp"
#include "rave/protocol/pulse.hpp"
#include "rave/protocol/realities.hpp"
#include "rave/protocol/roster.hpp"
#include "rave/sim/engine.hpp"

namespace rave::real_time {

/// A host's end of a run in real time: it tells where its robots are and what they say, hears of
/// the robots of others, and shares the time of the run. Belongs to one thread.
class HostLink {
 public:
  struct Options {
    bus::BusConfig bus;
    lock_step::Identity self;
    /// The run has an environment manager, whose clock is that of the run. Without one the time of
    /// each host is its own.
    bool managed = true;
    bool sees = true;   ///< A robot here has use of where the others are.
    bool talks = true;  ///< A robot here has communicators.
    /// By robot, the number of its host; of a run in which a robot has two sets of drivers. Empty:
    /// none has.
    std::vector<std::uint32_t> host_of = {};
    Duration world_period = from_seconds(0.1);  ///< At which worlds should come.
    /// Before the start, without an environment manager for longer than this the run has ended for
    /// this host; 0: it waits without limit.
    Duration manager_patience{};
    LogSink* log = nullptr;  ///< Not owned; may be null.
    /// What is done with what others ask on the bus, inside the calls of this object; may be empty.
    bus::BeginWish begin_wish = {};
    bus::OnCommand on_command = {};  ///< The same of commands, which nobody answers.
  };
  /// Goes on the bus. `world` hears of other robots and what they say, inside the calls of this
  /// object; not owned. Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<HostLink>> open(Options options, LiveWorld& world);
  HostLink(const HostLink&) = delete;
  HostLink& operator=(const HostLink&) = delete;
  ~HostLink();

  /// What is told of the robots of this host, which nobody in the run waits for.
  [[nodiscard]] lock_step::Roster& roster() noexcept;

  /// Waits until the run has a time, all obstacles and, if it sees, a first world; from then on
  /// zero() stands.
  /// `stopping` is asked ten times a second. False: somebody wants to stop. The log is told for
  /// whom it waits. Errors: kState (this host is served by another process, or the manager does not
  /// fit).
  [[nodiscard]] Result<bool> await_start(const std::function<bool()>& stopping);
  /// When the run is 0, by the clock of this process. It does not change any more: what is learned
  /// of the manager's clock later is put on the stamps of messages alone.
  [[nodiscard]] std::chrono::steady_clock::time_point zero() const noexcept;
  /// Where worlds before the start showed robots that run here: an earlier process of this host
  /// left them there.
  [[nodiscard]] std::span<const RobotSight> starts() const noexcept;

  /// Sleeps until `due`, hearing what comes meanwhile; at least once, also if that is past. Returns
  /// early if the run has ended.
  void listen_until(std::chrono::steady_clock::time_point due);
  /// Tells those who look on how many robots of this host are real now, after a hand-over.
  void count_real(std::uint32_t robots) noexcept;
  /// Tells where robots of this engine are, as its last step sensed; those without a pose are left
  /// out. Nothing for an empty list.
  void tell(const sim::Engine& engine, std::span<const RobotId> robots);
  /// Sends what robots here said in a step, of each as much as its TalkLimit lets pass. Waits for
  /// nobody.
  void send(const sim::SentPackets& sent);
  /// Who has exceeded it since the last call; each robot once in a run.
  [[nodiscard]] std::vector<RobotId> take_flooders();

  /// How this host keeps its deadlines, for those who look on.
  void note_lateness(lock_step::Pulse::Lateness lateness);

  /// The last step has the obstacles of LiveWorld::shown_revision() around its robots; the manager
  /// is told when that is more than before.
  void obstacles_shown();

  /// Sends what this host knows of the run to the environment manager, once, when the run is over
  /// for it: waits until that has it, ten seconds at most. Nothing without a manager, or before the
  /// start. Errors: those of lock_step::FindingsSender::send().
  [[nodiscard]] Status deliver(std::span<const std::byte> findings);

  /// What hosts have said of theirs since the last call; see Options::host_of.
  [[nodiscard]] std::vector<RobotReality> take_realities();

  /// For how long no world has come; 0 if it does not see.
  [[nodiscard]] Duration world_age() const;
  /// What of the manager's clock is known: that clock minus the one here.
  [[nodiscard]] std::optional<bus::ClockReading> clock() const;
  /// What the manager says of the end of the run; nothing before.
  struct Ending {
    bool good = false;
    std::string text;
  };
  [[nodiscard]] const std::optional<Ending>& ending() const noexcept;
  /// How many messages of robots here were dropped since they had exceeded it.
  [[nodiscard]] std::uint64_t withheld_packets() const noexcept;
  /// How many messages of robots here were dropped since some other process does not keep up.
  [[nodiscard]] std::uint64_t unsent_packets() const noexcept;
  /// How many messages of robots of other hosts were on the bus and did not get here.
  [[nodiscard]] std::uint64_t lost_packets() const noexcept;
  /// How many worlds have come, and how often they failed to for longer than three periods and half
  /// a second.
  [[nodiscard]] std::uint64_t worlds() const noexcept;
  [[nodiscard]] std::uint64_t losses() const noexcept;

 private:
  struct Impl;
  explicit HostLink(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::real_time
