// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "bus_face.hpp"
#include "live_twins.hpp"
#include "rave/assemble/build.hpp"
#include "rave/base/file.hpp"
#include "rave/control/requests.hpp"
#include "rave/host/host_journey.hpp"
#include "rave/pace/late_watch.hpp"
#include "rave/pace/stall_watch.hpp"
#include "rave/pace/wall_pace.hpp"
#include "rave/protocol/host_link.hpp"
#include "rave/results/event_log.hpp"
#include "rave/results/lateness_report.hpp"
#include "rave/results/radio_report.hpp"
#include "rave/results/shadow_report.hpp"
#include "waiting_robots.hpp"

namespace rave::runtime {
namespace {

using Clock = std::chrono::steady_clock;
using real_time::HostLink;
using real_time::LiveWorld;

/// Who begins so soon has missed nothing that anybody would miss.
constexpr std::int64_t kInTime_ns = 1'000'000'000;

/// How old what others see of hand-overs and shadows may be.
constexpr auto kLiveStatusInterval = std::chrono::milliseconds(50);

/// Local robots that say where they are in the same steps.
struct ReportGroup {
  std::uint32_t period_steps = 1;
  std::vector<RobotId> robots;  ///< Ascending.
};

std::vector<ReportGroup> report_groups(const config::ExpandedScenario& scenario, const Seat& seat) {
  std::vector<ReportGroup> groups;
  for (const RobotId robot : seat.robots) {
    const std::uint32_t period =
        config::report_period_steps(scenario, scenario.robots[robot.value()]);
    auto found = std::find_if(groups.begin(), groups.end(), [&](const ReportGroup& group) {
      return group.period_steps == period;
    });
    if (found == groups.end()) found = groups.insert(found, {period, {}});
    found->robots.push_back(robot);
  }
  return groups;
}

struct LiveJourney : HostJourney {
  LiveJourney(HostJourney host, HostLink& to, const BusFace& shown, LiveWorld& around,
              WallPace& clock, std::vector<ReportGroup> groups, std::span<const RobotId> own)
      : HostJourney(std::move(host)),
        link(to),
        face(shown),
        live(around),
        pace(clock),
        reports(std::move(groups)),
        twins(engine, own),
        watch(&console),
        late(clock.period_of(engine.spec().step), console, options.run.control) {}

  HostLink& link;
  const BusFace& face;
  LiveWorld& live;
  WallPace& pace;
  std::vector<ReportGroup> reports;
  LiveTwins twins;
  Clock::time_point next_status{};
  StallWatch watch;
  LateWatch late;
  std::uint64_t steps = 0;  ///< In all.
  std::uint64_t first = 0;  ///< The one that this host began with.
  sim::HostReport report;
  sim::WorldStep world;
  std::vector<RobotId> due;
};

/// Tells the others where robots are whose turn it is.
void tell_places(LiveJourney& journey) {
  journey.due.clear();
  for (const ReportGroup& group : journey.reports) {
    if (journey.report.step % group.period_steps != 0) continue;
    journey.due.insert(journey.due.end(), group.robots.begin(), group.robots.end());
  }
  std::sort(journey.due.begin(), journey.due.end());
  journey.link.tell(journey.engine, journey.due, journey.face.robots_asked());
}

/// Until the next step is due; false: there is none for this host.
bool wait_for_turn(LiveJourney& journey) {
  const sim::Engine& engine = journey.engine;
  const auto next = static_cast<std::int64_t>(journey.report.step);
  const auto due = journey.pace.wall_time_of(SimTime{next * engine.spec().step.ns});
  auto now = Clock::now();
  const bool slept = now < due;
  do {
    journey.link.listen_until(std::min(due, now + kProgressInterval));
    serve_requests(journey);
    journey.stopped = journey.stopping();
    journey.ended = journey.link.ending().has_value();
    if (journey.stopped || journey.ended) return false;
    now = Clock::now();
  } while (now < due);
  if (!slept) journey.late.count().did(Lateness::Part::kExchange, now);
  journey.late.count().woke(due, now);
  return true;
}

void name_flooders(LiveJourney& journey, const std::vector<RobotId>& robots) {
  for (const RobotId robot : robots) {
    journey.console.warn("radio",
                         "robot `{}` sends more than {} messages or {} bytes per step to other "
                         "hosts; the rest is dropped",
                         journey.engine.spec().robots[robot.value()].name,
                         real_time::TalkLimit::kMessagesPerStep,
                         real_time::TalkLimit::kBytesPerStep);
  }
}

/// How hand-overs and shadows stand changes though nobody asks for anything.
void show_status(LiveJourney& journey) {
  RunControl* const control = journey.options.run.control;
  const auto now = Clock::now();
  const bool changes = journey.twins.any() || journey.observers.has_orders();
  if (control == nullptr || !changes || now < journey.next_status) return;
  journey.next_status = now + kLiveStatusInterval;
  control->refresh([&journey](RunStatus& status) { refresh(journey, status); });
}

/// All look at the step that is done.
void look_back(LiveJourney& journey) {
  Lateness& count = journey.late.count();
  count.worked(journey.engine.phase_times(), Clock::now());
  look_back(journey, journey.live.events(), journey.world.resized, journey.late.behind());
  count.did(Lateness::Part::kOnlookers, Clock::now());
  journey.late.look(journey.engine.spec(), journey.engine.events(), journey.link.world_age());
}

/// For those who look on at all hosts.
lock_step::Pulse::Lateness pulse_of(const LateWatch& late) {
  const auto status = late.status().value_or(RunStatus::Lateness());
  return {status.deadlines, status.missed, from_seconds(status.worst_s).ns,
          from_seconds(status.behind_s).ns, status.phase};
}

Status make_step(LiveJourney& journey) {
  sim::Engine& engine = journey.engine;
  Lateness& count = journey.late.count();
  journey.watch.step_begins(journey.report.step);
  // The world of a step that comes late is one of before: no guard may take it for the present.
  engine.set_world_age(std::max(journey.link.world_age(), journey.late.age()));
  RAVE_TRY(journey.twins.follow(engine, journey.live, journey.link));
  RAVE_TRY(journey.live.step(journey.report, journey.world));
  count.did(Lateness::Part::kExchange, Clock::now());
  RAVE_TRY(engine.join(journey.world, {}));
  count.worked(engine.phase_times(), Clock::now());
  journey.link.obstacles_shown();
  tell_places(journey);
  count.did(Lateness::Part::kExchange, Clock::now());
  RAVE_TRY(engine.propose(journey.report));
  count.worked(engine.phase_times(), Clock::now());
  journey.link.send(journey.report.sent);
  name_flooders(journey, journey.link.take_flooders());
  name_flooders(journey, journey.live.take_flooders());
  count.did(Lateness::Part::kExchange, Clock::now());
  show_status(journey);
  journey.watch.step_ends();
  journey.late.step_done();
  journey.link.note_lateness(pulse_of(journey.late));
  return {};
}

Status go_through(LiveJourney& journey) {
  RAVE_TRY(journey.engine.propose(journey.report));
  const std::int64_t step_ns = journey.engine.spec().step.ns;
  const std::int64_t now_ns = std::max<std::int64_t>(0, journey.pace.now().ns);
  journey.first = static_cast<std::uint64_t>((now_ns + step_ns - 1) / step_ns);
  if (journey.first >= journey.steps) {
    journey.problems.emplace_back("arrived after the end of the run");
    return {};
  }
  RAVE_TRY(journey.live.begin_at(journey.first, journey.link.starts(), journey.report));
  if (now_ns > kInTime_ns) {
    std::string text =
        fmt::format("joins at {:.2f} s of the run", static_cast<double>(now_ns) * 1e-9);
    journey.console.info("host", "{}", text);
    journey.problems.push_back("it " + std::move(text));
  }
  while (journey.report.step < journey.steps && wait_for_turn(journey)) {
    RAVE_TRY(make_step(journey));
  }
  const auto last = static_cast<std::int64_t>(journey.steps - 1) * step_ns;
  journey.late.end(journey.pace.wall_time_of(SimTime{last}));
  // The last step takes its time, too.
  if (!journey.stopped && !journey.ended) static_cast<void>(wait_for_turn(journey));
  return {};
}

void add(std::vector<std::string> problems, std::vector<std::string>& to) {
  to.insert(to.end(), std::make_move_iterator(problems.begin()),
            std::make_move_iterator(problems.end()));
}

HostOutcome judge(const LiveJourney& journey, const std::string& live_reason) {
  HostOutcome outcome;
  outcome.live_reason = live_reason;
  outcome.steps =
      journey.engine.steps_done() - std::min(journey.first, journey.engine.steps_done());
  const auto ending = journey.link.ending();
  note_end(journey, ending ? ending->text : "", !ending || ending->good, outcome);
  return outcome;
}

Status write_results(const LiveJourney& journey, const RunFacts& facts,
                     const HostOutcome& outcome) {
  const std::filesystem::path& folder = journey.options.run.output;
  nlohmann::ordered_json json;
  json["host"] = journey.options.host;
  json["whole"] = outcome.whole;
  json["first_step"] = journey.first;
  json["steps"] = outcome.steps;
  json["hash"] = nullptr;
  json["no_hash_because"] = outcome.live_reason;
  const auto clock = journey.link.clock();
  json["clock_offset_s"] = clock ? nlohmann::ordered_json(clock->offset.seconds()) : nullptr;
  json["clock_bound_s"] = clock ? nlohmann::ordered_json(clock->bound.seconds()) : nullptr;
  json["lateness"] = lateness_json(facts.lateness);
  json["worlds"] = journey.link.worlds();
  json["world_losses"] = journey.link.losses();
  if (has_radio(journey.engine.spec())) {
    json["radio"] = radio_json(facts.radio);
    json["radio"]["transmitters"] = transmitters_json(journey.engine.spec(), facts.transmitters);
  }
  json["lost_packets"] = journey.link.lost_packets();
  json["unsent_packets"] = journey.link.unsent_packets();
  json["withheld_packets"] = journey.link.withheld_packets();
  json["dropped_packets"] = journey.live.dropped_packets();
  json["events"] = journey.events.size();
  if (!facts.shadows.empty()) json["shadows"] = shadows_json(facts.shadows);
  json["ending"] = outcome.ending;
  json["problems"] = outcome.problems;
  RAVE_TRY(write_file_atomically(
      folder / "events.log",
      events_log(journey.engine.spec(), journey.observers.results().kinds, journey.events)));
  return write_file_atomically(
      folder / "result.json",
      json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

Result<HostLink::Options> link_options(const LiveHost& host, const BuiltScenario& built) {
  HostLink::Options options;
  options.bus = host.options.bus;
  // Robots of all hosts talk to one another.
  options.bus.reach = bus::Reach::kAll;
  options.self = {host.seat.number,
                  host.options.host,
                  static_cast<std::uint32_t>(host.seat.robots.size()),
                  shared_number(host.scenario),
                  interface_stamp(),
                  true};
  options.self.real_robots = real_robots(built.spec, host.seat.robots);
  options.managed = needs_manager(built);
  RAVE_TRY_ASSIGN(options.host_of, hosts_of_twins(host.scenario, built.spec));
  options.sees = false;
  options.talks = false;
  for (const RobotId robot : host.seat.robots) {
    const std::uint32_t type = built.spec.robots[robot.value()].type;
    options.sees = options.sees || built.sees[type] != 0;
    options.talks = options.talks || !built.spec.types[type].communicators.empty();
  }
  options.world_period = from_seconds(host.scenario.scenario.world_period_s);
  options.manager_patience = host.options.manager_patience;
  options.log = &host.console;
  options.begin_wish = host.options.begin_wish;
  options.on_command = host.options.on_command;
  return options;
}

/// What is left to do when all is there.
Result<HostOutcome> go(const LiveHost& host, sim::Engine& engine, HostLink& link, LiveWorld& live,
                       const BuiltScenario& built, bool begun, std::function<void()>& look) {
  RunOptions run = host.options.run;
  // With a manager the link hands on what that says of obstacles.
  RAVE_TRY_ASSIGN(const auto face, BusFace::open(link.bus(), host.seat.number,
                                                 !needs_manager(built), &host.catalogue));
  run.observers.push_back(face.get());
  RAVE_TRY_ASSIGN(
      const auto observers,
      ObserverList::open({host.scenario, host.expanded, built.robot_kinds, engine, host.catalogue,
                          run, host.console, host.options.host, true, true}));
  const config::ScenarioFile& file = host.scenario.scenario;
  LiveJourney journey(
      {engine, *observers, link.roster(), host.options, host.console, shared_number(host.scenario)},
      link, *face, live, host.pace, report_groups(host.scenario, host.seat), host.seat.robots);
  look = [&journey] { look_back(journey); };
  journey.steps = steps_of(file);
  observers->on_place([&live](const sim::WorldInput& input) { return live.place(input); });
  const ControlledHost controlled(engine, file, run.control, true);
  tell_who_waits(engine, run, host.console);
  Status went;
  if (begun) {
    went = go_through(journey);
  } else {
    journey.stopped = journey.stopping();
    journey.ended = link.ending().has_value();
  }
  engine.halt();
  const std::string record_problem = observers->end_record(std::nullopt);
  add(lateness_problems(journey.late.facts(), file.max_missed_pct), journey.problems);
  HostOutcome outcome = judge(journey, built.live_reason);
  RunFacts facts = gather(observers->results(), engine);
  facts.first_step = journey.first;
  facts.problems = journey.problems;
  facts.lateness = journey.late.facts();
  if (observers->shadows() != nullptr) facts.shadows = observers->shadows()->facts();
  if (!record_problem.empty()) {
    outcome.problems.push_back(record_problem);
    facts.problems.push_back(record_problem);
  }
  outcome.whole = outcome.whole && outcome.problems.empty();
  // A full disk here is no reason to keep from others what this host knows.
  const Status written = write_results(journey, facts, outcome);
  RAVE_TRY(leave_facts(journey, encode_facts(journey, std::move(facts)),
                       [&link](std::span<const std::byte> bytes) { return link.deliver(bytes); }));
  RAVE_TRY(written);
  if (!went) return tl::unexpected(went.error());
  return outcome;
}

}  // namespace

Result<HostOutcome> run_live_host(const LiveHost& host, BuiltScenario built) {
  host.console.warn("run", "the run is in real time: {}", built.live_reason);
  for (const std::string& note : built.notes) host.console.warn("scenario", "{}", note);
  built.spec.own_authority = true;
  built.spec.phase_clock = steady_ns;
  RAVE_TRY_ASSIGN(const auto live, LiveWorld::create(built.spec, !needs_manager(built)));
  RAVE_TRY_ASSIGN(auto options, link_options(host, built));
  RAVE_TRY_ASSIGN(const auto link, HostLink::open(std::move(options), *live));
  const config::ScenarioFile& file = host.scenario.scenario;
  link->word().describe(file.name.value, steps_of(file), file.step_s.value);
  introduce_robots(link->roster(), built.spec, host.seat.robots, host.console);
  // The run starts when all devices are open here, and everywhere.
  RunControl* const control = host.options.run.control;
  Result<bool> begun = false;
  built.spec.on_ready = [&] {
    begun = link->await_start([control] { return control != nullptr && control->stopping(); });
    host.pace.start_at(link->zero());
  };
  std::function<void()> look;
  built.spec.on_step_done = [&look] { look(); };
  RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(built.spec)));
  if (!begun) return tl::unexpected(begun.error());
  return go(host, *engine, *link, *live, built, *begun, look);
}

}  // namespace rave::runtime
