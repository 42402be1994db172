// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/bus.hpp"
#include "rave/bus/wish_book.hpp"
#include "rave/protocol/introduction.hpp"
#include "rave/protocol/roster.hpp"
#include "rave/sim/authority_state.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/host_report.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::lock_step {

/// A host's end of a run in lock-step: it sends reports to the environment manager, whoever and
/// wherever that is, and gets the world. Belongs to one thread.
class HostPort {
 public:
  enum class Answer : std::uint8_t {
    kWorld,  ///< `world` is that of the reported step; or of a later one, if the run went on alone.
    kStopped,  ///< Somebody here wants to stop.
    kEnded,    ///< The run has ended; ending() says how.
  };

  /// Without an environment manager for longer than this the run has ended for a host.
  struct Patience {
    Duration usual;  ///< 0: it waits without limit.
    /// When it is missed after this process stood still for longer than half its lease, and the run
    /// did not wait; 0: as usual.
    Duration after_standstill;
  };

  /// Goes on the bus. `log` is not owned and may be null. `begin_wish`, called in exchange(): what
  /// is done with what others ask on the bus; may be empty. Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<HostPort>> open(const bus::BusConfig& bus,
                                                              Identity identity, LogSink* log,
                                                              Patience patience = {},
                                                              bus::BeginWish begin_wish = {});
  HostPort(const HostPort&) = delete;
  HostPort& operator=(const HostPort&) = delete;
  ~HostPort();

  /// Sends a report, again and again until it is answered, and waits for the answer; `stopping` is
  /// asked ten times a second. `world` is the last answer until it becomes the next one: it is
  /// handed to an environment manager that was started anew, which goes on from there. While nobody
  /// answers, the log is told for whom all wait. Errors: kState (this host is served by another
  /// process already; the manager has another scenario or interface), kInvalidArgument (the report
  /// is larger than what the bus carries).
  [[nodiscard]] Result<Answer> exchange(const sim::HostReport& report, std::uint64_t hash,
                                        sim::WorldStep& world,
                                        const std::function<bool()>& stopping);
  /// Says where robots of this host are, for those who look on: 30 times a second at most, and
  /// while somebody reads it. Nobody in the run does.
  void show(const sim::Engine& engine, std::span<const RobotId> robots);
  /// What is told of the robots of this host, which nobody in the run waits for.
  [[nodiscard]] Roster& roster() noexcept;
  /// What the authority knew beside the last world, with the obstacles of before only if this host
  /// had missed some.
  [[nodiscard]] const sim::AuthorityState& authority() const noexcept;
  /// Whether another authority than the first has answered: the one that is there at the end has
  /// not seen all of the run.
  [[nodiscard]] bool changed_hands() const noexcept;
  /// After kEnded: whether the run ended as it should, and what its manager says of it.
  struct Ending {
    bool good = false;
    std::string text;
  };
  [[nodiscard]] const Ending& ending() const noexcept;

  /// Sends a last report without waiting for an answer: `state` says that this host is done or has
  /// failed.
  void farewell(const sim::HostReport& report, std::uint64_t hash);

  /// Sends what this host knows of the run to the environment manager, once, when the run is over
  /// for it: waits until that has it, ten seconds at most. Nothing for a host that never took part.
  /// Errors: those of FindingsSender::send().
  [[nodiscard]] Status deliver(std::span<const std::byte> findings);

 private:
  struct Impl;
  explicit HostPort(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::lock_step
