// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/bus.hpp"
#include "rave/bus/command_box.hpp"
#include "rave/bus/request_book.hpp"
#include "rave/protocol/host_word.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/protocol/roster.hpp"
#include "rave/protocol/run_words.hpp"
#include "rave/sim/authority_state.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/host_report.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::lock_step {

/// A host's connection to a run in lock-step: it sends reports to the Environment Manager, wherever
/// that is, and receives the world. Belongs to one thread.
class HostPort {
 public:
  enum class Answer : std::uint8_t {
    kWorld,    ///< `world` is that of the reported step, or of a later one if the run continued
               ///< without this host.
    kStopped,  ///< `stopping` returned true.
    kEnded,    ///< The run has ended; see ending().
  };

  /// How long a host waits without an Environment Manager before the run ends for it.
  struct Patience {
    Duration usual;  ///< 0: no limit.
    /// Used after this process was unable to run for longer than half its lease, unless the run
    /// waits for it; 0: as usual.
    Duration after_standstill;
  };

  /// Joins the bus. `log` is not owned and may be null. `begin_request` handles bus requests of
  /// others and `begin_command` their commands, inside exchange(); both may be empty. Errors: those
  /// of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<HostPort>> open(const bus::BusConfig& bus,
                                                              Identity identity, LogSink* log,
                                                              Patience patience = {},
                                                              bus::BeginRequest begin_request = {},
                                                              bus::BeginCommand begin_command = {});
  HostPort(const HostPort&) = delete;
  HostPort& operator=(const HostPort&) = delete;
  ~HostPort();

  /// When exchange() calls `stopping` before its time.
  struct Look {
    std::stop_token asked{};                ///< As soon as this is requested, and
    std::chrono::milliseconds within{100};  ///< after this time.
  };
  /// Sends a report repeatedly until it is answered. `stopping` is called ten times a second, or as
  /// `look` says, which is asked anew after each call; it may add inputs to `report`, which is then
  /// sent again at once. `world` must be the last answer, and receives the new one. If the
  /// Environment Manager was restarted, it gets the last answer, to continue from there. While
  /// there is no answer, the log names the hosts that all wait for. Errors: kState (another process
  /// already serves this host; the manager has another scenario or interface), kInvalidArgument
  /// (the report is larger than the bus can carry).
  [[nodiscard]] Result<Answer> exchange(const sim::HostReport& report, std::uint64_t hash,
                                        sim::WorldStep& world,
                                        const std::function<bool()>& stopping,
                                        const std::function<Look()>& look = {});
  /// Answers requests of others that have been handled since exchange(), without waiting for it.
  void serve();
  /// Publishes the states of this host's robots for monitors: at most 30 times a second, and only
  /// while a process reads it. No process of the run does.
  void show(const sim::Engine& engine, std::span<const RobotId> robots);
  /// While the next step is waited for: publishes the states of the last step if show() left them
  /// out. So monitors of a paused run see where its robots stand.
  void show_rest(const sim::Engine& engine, std::span<const RobotId> robots);
  /// The state of the run for monitors; not published before its scenario was set.
  [[nodiscard]] HostWord& word() noexcept;
  /// The bus, for objects of this thread that end before it.
  [[nodiscard]] bus::Bus& bus() noexcept;
  /// The roster of this host's robots; nothing in the run waits for it.
  [[nodiscard]] Roster& roster() noexcept;
  /// What the run waits for, as its manager says it; empty: it continues, or the reason is unknown.
  [[nodiscard]] const std::string& waits_for() const noexcept;
  /// The state of the authority for the last world. It includes earlier obstacle changes only if
  /// this host had missed some.
  [[nodiscard]] const sim::AuthorityState& authority() const noexcept;
  /// Whether the authority has changed during the run, so that the present one has not seen all of
  /// it.
  [[nodiscard]] bool changed_hands() const noexcept;
  /// The end of the run according to the manager; empty before.
  [[nodiscard]] const std::optional<RunEnding>& ending() const noexcept;

  /// Sends a last report without waiting for an answer; its `state` says that this host is done or
  /// has failed.
  void farewell(const sim::HostReport& report, std::uint64_t hash);

  /// Sends the results of this host to the Environment Manager once, at the end of the run,
  /// and waits for the acknowledgement, ten seconds at most. No effect for a host that never took
  /// part. Errors: those of HostResultsSender::send().
  [[nodiscard]] Status deliver(std::span<const std::byte> host_results);

 private:
  struct Impl;
  explicit HostPort(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::lock_step
