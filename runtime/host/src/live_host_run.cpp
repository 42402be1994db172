// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "host_session.hpp"
#include "live_twins.hpp"
#include "rave/protocol/host_link.hpp"
#include "rave/results/result_parts.hpp"

namespace rave::runtime {
namespace {

using Clock = std::chrono::steady_clock;
using real_time::HostLink;
using real_time::LiveWorld;

/// Who begins so soon has missed nothing that anybody would miss.
constexpr std::int64_t kInTime_ns = 1'000'000'000;

/// Local robots that say where they are in the same steps.
struct ReportGroup {
  std::uint32_t period_steps = 1;
  std::vector<RobotId> robots;  ///< Ascending.
};

std::vector<ReportGroup> report_groups(const config::ExpandedScenario& scenario,
                                       const HostPart& part) {
  std::vector<ReportGroup> groups;
  for (const RobotId robot : part.robots) {
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

/// Hosts do not wait for one another: this one resolves the motion of its own robots, and hears
/// where the others are.
class LiveExchange final : public HostExchange {
 public:
  /// `begun`: the run has started, or else was ended before.
  LiveExchange(RunSession& run, HostLink& link, LiveWorld& world, const BusFace& face,
               const HostSetup& host, bool begun)
      : run_(run),
        link_(link),
        live_(world),
        face_(face),
        begun_(begun),
        groups_(report_groups(host.scenario, host.part)),
        twins_(run.engine, host.part.robots) {
    run.observers.on_place([&world](const sim::WorldInput& input) { return world.place(input); });
  }

  Result<bool> begin() override;
  Result<bool> await_turn() override;
  Status step() override;
  void step_done() override {
    look_back(run_, live_.events(), link_.world_age());
    keep_roster(link_.roster(), run_.engine, run_.observers, run_.console);
  }
  const std::optional<lock_step::RunEnding>& ending() const override { return link_.ending(); }
  void complete(RunFacts& facts) override {
    const real_time::PoseDelays& delays = live_.pose_delays();
    facts.poses = {delays.count, delays.slowest.ns, delays.sum.ns};
  }
  void describe(nlohmann::ordered_json& json, const HostOutcome& outcome,
                const RunFacts& facts) const override;
  Status deliver(std::span<const std::byte> host_results) override {
    return link_.deliver(host_results);
  }

 private:
  bool asked_to_end();
  void tell_places();
  void name_flooders(const std::vector<RobotId>& robots);

  RunSession& run_;
  HostLink& link_;
  LiveWorld& live_;
  const BusFace& face_;
  const bool begun_;
  std::vector<ReportGroup> groups_;
  LiveTwins twins_;
  sim::HostReport report_;
  sim::WorldStep world_;
  std::vector<RobotId> due_;
};

bool LiveExchange::asked_to_end() {
  run_.stopped = run_.stopping();
  run_.ended = link_.ending().has_value();
  return run_.stopped || run_.ended;
}

Result<bool> LiveExchange::begin() {
  if (!begun_) {
    asked_to_end();
    return false;
  }
  RAVE_TRY(run_.engine.propose(report_));
  const std::int64_t step_ns = run_.engine.spec().step.ns;
  const std::int64_t now_ns = std::max<std::int64_t>(0, run_.pace.now().ns);
  run_.first = static_cast<std::uint64_t>((now_ns + step_ns - 1) / step_ns);
  if (run_.first >= run_.steps) {
    run_.problems.emplace_back("arrived after the end of the run");
    return false;
  }
  RAVE_TRY(live_.begin_at(run_.first, link_.starts(), report_));
  if (now_ns > kInTime_ns) {
    std::string text =
        fmt::format("joins at {:.2f} s of the run", static_cast<double>(now_ns) * 1e-9);
    run_.console.info("host", "{}", text);
    run_.problems.push_back("it " + std::move(text));
  }
  return true;
}

/// Until the next step is due; the last step takes its time, too.
Result<bool> LiveExchange::await_turn() {
  // For monitors of all hosts.
  const auto late = run_.late.status().value_or(RunStatus::Lateness());
  link_.note_lateness({late.deadlines, late.missed, from_seconds(late.worst_s).ns,
                       from_seconds(late.behind_s).ns, late.phase});
  run_.step = report_.step;
  const auto next = static_cast<std::int64_t>(run_.step);
  const auto due = run_.pace.wall_time_of(SimTime{next * run_.engine.spec().step.ns});
  auto now = Clock::now();
  const bool slept = now < due;
  do {
    link_.listen_until(std::min(due, now + kProgressInterval));
    serve_requests(run_);
    if (asked_to_end()) return false;
    now = Clock::now();
  } while (now < due);
  if (!slept) run_.late.count().did(Lateness::Part::kExchange, now);
  run_.late.count().woke(due, now);
  return run_.step < run_.steps;
}

Status LiveExchange::step() {
  sim::Engine& engine = run_.engine;
  Lateness& count = run_.late.count();
  // The world of a step that comes late is one of before: no guard may take it for the present.
  engine.set_world_age(std::max(link_.world_age(), run_.late.age()));
  RAVE_TRY(twins_.follow(engine, live_, link_));
  RAVE_TRY(live_.step(report_, world_));
  count.did(Lateness::Part::kExchange, Clock::now());
  RAVE_TRY(engine.join(world_, {}));
  count.worked(engine.phase_times(), Clock::now());
  link_.obstacles_shown();
  tell_places();
  count.did(Lateness::Part::kExchange, Clock::now());
  RAVE_TRY(engine.propose(report_));
  count.worked(engine.phase_times(), Clock::now());
  link_.send(report_.sent);
  name_flooders(link_.take_flooders());
  name_flooders(live_.take_flooders());
  count.did(Lateness::Part::kExchange, Clock::now());
  return {};
}

/// Tells the others where robots are whose turn it is.
void LiveExchange::tell_places() {
  due_.clear();
  for (const ReportGroup& group : groups_) {
    if (report_.step % group.period_steps != 0) continue;
    due_.insert(due_.end(), group.robots.begin(), group.robots.end());
  }
  std::sort(due_.begin(), due_.end());
  link_.tell(run_.engine, due_, face_.robots_asked());
}

void LiveExchange::name_flooders(const std::vector<RobotId>& robots) {
  for (const RobotId robot : robots) {
    run_.console.warn("radio",
                      "robot `{}` sends more than {} messages or {} bytes per step to other hosts; "
                      "the rest is dropped",
                      run_.engine.spec().robots[robot.value()].name,
                      real_time::TalkLimit::kMessagesPerStep, real_time::TalkLimit::kBytesPerStep);
  }
}

void LiveExchange::describe(nlohmann::ordered_json& json, const HostOutcome& outcome,
                            const RunFacts& facts) const {
  json["first_step"] = run_.first;
  json["steps"] = outcome.steps;
  json["hash"] = nullptr;
  json["no_hash_because"] = outcome.live_reason;
  const auto clock = link_.clock();
  json["clock_offset_s"] = clock ? nlohmann::ordered_json(clock->offset.seconds()) : nullptr;
  json["clock_bound_s"] = clock ? nlohmann::ordered_json(clock->bound.seconds()) : nullptr;
  json["lateness"] = lateness_json(facts.lateness);
  json["worlds"] = link_.worlds();
  json["world_losses"] = link_.losses();
  add_radio(run_.engine.spec(), facts, json);
  json["lost_packets"] = link_.lost_packets();
  json["unsent_packets"] = link_.unsent_packets();
  json["withheld_packets"] = link_.withheld_packets();
  json["dropped_packets"] = live_.dropped_packets();
}

Result<HostLink::Options> link_options(const HostSetup& host, const BuiltScenario& built) {
  HostLink::Options options;
  options.bus = host.options.bus;
  // Robots of all hosts talk to one another.
  options.bus.reach = bus::Reach::kAll;
  options.self = {host.part.number,
                  host.options.host,
                  static_cast<std::uint32_t>(host.part.robots.size()),
                  shared_number(host.scenario),
                  interface_stamp(),
                  true};
  options.self.real_robots = real_robots(built.spec, host.part.robots);
  options.self.folder = kept_folder(host.options.run);
  options.managed = needs_manager(built);
  RAVE_TRY_ASSIGN(options.host_of, hosts_of_twins(host.scenario, built.spec));
  options.sees = false;
  options.talks = false;
  for (const RobotId robot : host.part.robots) {
    const std::uint32_t type = built.spec.robots[robot.value()].type;
    options.sees = options.sees || built.sees[type] != 0;
    options.talks = options.talks || !built.spec.types[type].communicators.empty();
  }
  options.world_period = from_seconds(host.scenario.scenario.world_period_s);
  options.manager_patience = host.options.manager_patience;
  options.log = &host.console;
  options.begin_request = host.options.begin_request;
  options.begin_command = host.options.begin_command;
  return options;
}

}  // namespace

Result<HostOutcome> run_live_host(const HostSetup& host, BuiltScenario& built) {
  host.console.warn("run", "the run is in real time: {}", built.live_reason);
  for (const std::string& note : built.notes) host.console.warn("scenario", "{}", note);
  built.spec.own_authority = true;
  built.spec.phase_clock = steady_ns;
  RAVE_TRY_ASSIGN(const auto live, LiveWorld::create(built.spec, !needs_manager(built)));
  RAVE_TRY_ASSIGN(auto options, link_options(host, built));
  RAVE_TRY_ASSIGN(const auto link, HostLink::open(std::move(options), *live));
  const config::ScenarioFile& file = host.scenario.scenario;
  link->word().describe(file.name.value, steps_of(file), file.step_s.value);
  introduce_robots(link->roster(), built.spec, host.part.robots, host.console);
  // The run starts when all devices are open here, and everywhere.
  RunControl* const control = host.options.run.control;
  Result<bool> begun = false;
  built.spec.on_ready = [&] {
    begun = link->await_start([control] { return control != nullptr && control->stopping(); });
    host.pace.start_at(link->zero());
  };
  std::function<void()> on_step_done;
  built.spec.on_step_done = [&on_step_done] { on_step_done(); };
  RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(built.spec)));
  if (!begun) return tl::unexpected(begun.error());
  const auto make = [&](RunSession& run, const BusFace& face) {
    return std::make_unique<LiveExchange>(run, *link, *live, face, host, *begun);
  };
  return run_session(host, *engine, link->bus(), make, on_step_done);
}

}  // namespace rave::runtime
