// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

#include "bus_face.hpp"
#include "rave/assemble/build.hpp"
#include "rave/host/host_part.hpp"
#include "rave/host/host_run.hpp"
#include "rave/protocol/roster.hpp"
#include "rave/protocol/run_words.hpp"
#include "rave/results/facts.hpp"
#include "run_session.hpp"

namespace rave::runtime {

/// What both kinds of host get from run_host(), which has built their robots.
struct HostSetup {
  const config::ExpandedScenario& scenario;
  const std::string& expanded;  ///< The same as a file.
  plugin::Catalogue& catalogue;
  const HostOptions& options;
  const HostPart& part;
  ConsoleTee& console;
  WallPace& pace;
  const BuiltScenario& built;  ///< Its spec is moved into the engine.
};

/// What is beside the loop different for a host in lock-step and for one in real time.
class HostExchange : public WorldExchange {
 public:
  /// A step is done (EngineSpec::on_step_done).
  virtual void step_done() = 0;
  /// How the environment manager ended the run; empty before.
  [[nodiscard]] virtual const std::optional<lock_step::RunEnding>& ending() const = 0;
  /// Adds to `facts` what only the exchange knows.
  virtual void complete(RunFacts& facts) = 0;
  /// Adds to result.json, behind `whole`, what only this kind of run has.
  virtual void describe(nlohmann::ordered_json& json, const HostOutcome& outcome,
                        const RunFacts& facts) const = 0;
  /// Sends the results of this host to the environment manager.
  virtual Status deliver(std::span<const std::byte> host_results) = 0;
};

/// The exchange of a run whose session is there.
using MakeExchange =
    std::function<std::unique_ptr<HostExchange>(RunSession& run, const BusFace& face)>;

/// How many of the robots are real ones.
[[nodiscard]] std::uint32_t real_robots(const sim::EngineSpec& spec,
                                        std::span<const RobotId> robots);

/// Where a host leaves its recording, for its introduction; empty: nowhere.
[[nodiscard]] std::string kept_folder(const RunOptions& run);

/// Describes robots that nothing runs yet, as their files have them, to monitors. No monitor
/// waits for that, and what is wrong with it is a warning in `log`.
void introduce_robots(lock_step::Roster& roster, const sim::EngineSpec& spec,
                      std::span<const RobotId> robots, LogSink& log);

/// Monitors get what robots have become in the last step.
void keep_roster(lock_step::Roster& roster, const sim::Engine& engine, ObserverList& observers,
                 LogSink& log);
/// The same of who drives them, at any time.
void tell_roster(lock_step::Roster& roster, const sim::Engine& engine, ObserverList& observers,
                 LogSink& log);

/// run_host() when all is there: observers, the loop, and what it leaves. `bus` and `engine`
/// outlive the call; the engine calls `on_step_done`, which is set here.
[[nodiscard]] Result<HostOutcome> run_session(const HostSetup& host, sim::Engine& engine,
                                              bus::Bus& bus, const MakeExchange& make,
                                              std::function<void()>& on_step_done);

/// run_host() of a run in real time. `built`: that of `host`.
[[nodiscard]] Result<HostOutcome> run_live_host(const HostSetup& host, BuiltScenario& built);

}  // namespace rave::runtime
