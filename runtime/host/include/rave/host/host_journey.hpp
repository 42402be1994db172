// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "rave/assemble/build.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/host/host_run.hpp"
#include "rave/host/observer_list.hpp"
#include "rave/pace/wall_pace.hpp"
#include "rave/protocol/roster.hpp"
#include "rave/recording/console_tee.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::runtime {

/// The number and the robots of a host that is named.
struct Seat {
  std::uint32_t number = 0;
  std::vector<RobotId> robots;
};

/// Error kNotFound: the scenario has no hosts, or none of this name.
[[nodiscard]] Result<Seat> find_seat(const config::ExpandedScenario& scenario,
                                     const std::string& name);

/// How many of the robots are real ones.
[[nodiscard]] std::uint32_t real_robots(const sim::EngineSpec& spec,
                                        std::span<const RobotId> robots);

/// One host on its way through a run, whether the hosts wait for one another or not.
struct HostJourney {
  sim::Engine& engine;
  ObserverList& observers;
  lock_step::Roster& roster;
  const HostOptions& options;
  ConsoleTee& console;
  std::uint64_t run_number;  ///< shared_number() of its scenario.
  std::vector<sim::Event> events{};
  std::vector<std::string> losses{};    ///< Of programs and drivers, which are events, too.
  std::vector<std::string> problems{};  ///< What else is not as it should be.
  bool world_tells = false;             ///< What concerns no robot is for the manager to note.
  bool stopped = false;
  bool ended = false;  ///< By the manager.

  [[nodiscard]] bool stopping() const {
    return options.run.control != nullptr && options.run.control->stopping();
  }
};

/// Describes robots that nothing runs yet, as their files have them, to whoever looks on. Nobody
/// waits for that, and what is wrong with it is a warning in `log`.
void introduce_robots(lock_step::Roster& roster, const sim::EngineSpec& spec,
                      std::span<const RobotId> robots, LogSink& log);

/// Does what somebody has asked for since the last step.
void serve_requests(HostJourney& journey);

/// Brings up to date what others see of this host.
void refresh(const HostJourney& journey, RunStatus& status);

/// A step is done (EngineSpec::on_step_done): all look at it, it is recorded, its events are told,
/// and those that `beside` the engine has. `resized`: who has another size in this step, robots of
/// other hosts too.
void look_back(HostJourney& journey, std::span<const sim::Event> beside,
               std::span<const sim::ResizedRobot> resized, bool late);

/// What ended a host's part beside its losses: that it was stopped, or how the manager ended it.
void note_end(const HostJourney& journey, std::string_view ending, bool good, HostOutcome& outcome);

/// What this host knows of the run, as bytes for the results of the whole (facts_file.hpp).
[[nodiscard]] std::vector<std::byte> encode_facts(const HostJourney& journey, RunFacts facts);

/// Leaves them in the folder of this host, and lets `deliver` send them to the environment manager;
/// the log is told if they do not get there. Errors: kIo (they could not be left; they were sent).
Status leave_facts(const HostJourney& journey, std::span<const std::byte> bytes,
                   const std::function<Status(std::span<const std::byte>)>& deliver);

/// What the world says of obstacles in its step; an engine that is one of several hosts has no
/// events of them.
[[nodiscard]] std::vector<sim::Event> obstacle_events(const sim::WorldStep& world);

/// Lets others control a host as long as it goes.
class ControlledHost {
 public:
  ControlledHost(const sim::Engine& engine, const config::ScenarioFile& file, RunControl* control,
                 bool live);
  ControlledHost(const ControlledHost&) = delete;
  ControlledHost& operator=(const ControlledHost&) = delete;
  ~ControlledHost();

 private:
  RunControl* control_;
};

/// What a host in real time gets from run_host(), which has built its robots.
struct LiveHost {
  const config::ExpandedScenario& scenario;
  const std::string& expanded;  ///< The same as a file.
  plugin::Catalogue& catalogue;
  const HostOptions& options;
  const Seat& seat;
  ConsoleTee& console;
  WallPace& pace;  ///< The clock of its live drivers; started here.
};

/// run_host() of a run in real time.
[[nodiscard]] Result<HostOutcome> run_live_host(const LiveHost& host, BuiltScenario built);

}  // namespace rave::runtime
