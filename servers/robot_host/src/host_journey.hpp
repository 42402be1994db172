// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "console_tee.hpp"
#include "rave/config/expanded_scenario.hpp"
#include "rave/robot_host/build.hpp"
#include "rave/robot_host/host_run.hpp"
#include "rave/sim/engine.hpp"
#include "record_keeper.hpp"
#include "wall_pace.hpp"

namespace rave::robot_host {

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
  RecordKeeper* record;  ///< May be null.
  const HostOptions& options;
  ConsoleTee& console;
  std::vector<sim::Event> events{};
  std::vector<std::string> problems{};
  bool stopped = false;
  bool ended = false;  ///< By the manager.

  [[nodiscard]] bool stopping() const {
    return options.run.control != nullptr && options.run.control->stopping();
  }
};

/// Does what somebody has asked for since the last step.
void serve_requests(HostJourney& journey);

/// A step is done, the report of the next one is there: records it and tells its events, and those
/// that `beside` the engine has.
void look_back(HostJourney& journey, std::span<const sim::Event> beside = {});

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

}  // namespace rave::robot_host
