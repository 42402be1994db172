// SPDX-License-Identifier: Apache-2.0
#include "host_journey.hpp"

#include <algorithm>

#include "event_log.hpp"
#include "rave/base/names.hpp"
#include "requests.hpp"

namespace rave::robot_host {

Result<Seat> find_seat(const config::ExpandedScenario& scenario, const std::string& name) {
  RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(scenario));
  std::vector<std::string_view> names;
  for (std::uint32_t h = 0; h < hosts.size(); ++h) {
    names.emplace_back(hosts[h].name);
    if (hosts[h].name != name) continue;
    Seat seat{h, {}};
    for (const std::size_t robot : hosts[h].robots) {
      seat.robots.emplace_back(static_cast<std::uint32_t>(robot));
    }
    return seat;
  }
  if (hosts.empty()) {
    return fail(ErrorCode::kNotFound,
                "the scenario `{}` has no hosts: expected `hosts:` with names and robots, or "
                "`processes:` with a number",
                scenario.scenario.name.value);
  }
  return fail(ErrorCode::kNotFound, "the scenario `{}` has no host `{}`{}",
              scenario.scenario.name.value, name, suggestion(name, names));
}

std::uint32_t real_robots(const sim::EngineSpec& spec, std::span<const RobotId> robots) {
  return static_cast<std::uint32_t>(std::ranges::count_if(robots, [&](RobotId robot) {
    return !spec.types[spec.robots[robot.value()].type].simulated;
  }));
}

void serve_requests(HostJourney& journey) {
  RunControl* const control = journey.options.run.control;
  if (control == nullptr) return;
  control->serve(
      [&journey](const RunRequest& request) {
        auto answer = serve_request(journey.engine, request);
        if (answer && journey.record != nullptr) journey.record->keep(request, journey.engine);
        return answer;
      },
      [&journey](RunStatus& status) { refresh_status(journey.engine, status); });
}

void look_back(HostJourney& journey, std::span<const sim::Event> beside) {
  sim::Engine& engine = journey.engine;
  if (engine.steps_done() == 0) return;
  RunControl* const control = journey.options.run.control;
  if (control != nullptr) control->set_time(engine.time().seconds());
  if (journey.record != nullptr) {
    journey.record->after_step(engine);
    journey.record->keep(beside);
  }
  tell_events(engine, engine.events(), &journey.console, journey.events);
  tell_events(engine, beside, &journey.console, journey.events);
  for (const sim::Event& event : engine.events()) {
    if (event.kind != sim::EventKind::kProgramFailed &&
        event.kind != sim::EventKind::kDriverFailed) {
      continue;
    }
    journey.problems.push_back(fmt::format(
        "robot `{}`: {} at {:.2f} s: {}", engine.spec().robots[event.robot.value()].name,
        to_string(event.kind), engine.time().seconds(), event.text));
  }
}

ControlledHost::ControlledHost(const sim::Engine& engine, const config::ScenarioFile& file,
                               RunControl* control, bool live)
    : control_(control) {
  if (control_ == nullptr) return;
  RunStatus status;
  status.scenario = file.name.value;
  status.duration_s = file.duration_s;
  status.pace = live ? 1 : file.pace.factor;
  status.live = live;
  refresh_status(engine, status);
  control_->begin(std::move(status));
}

ControlledHost::~ControlledHost() {
  if (control_ != nullptr) control_->end();
}

}  // namespace rave::robot_host
