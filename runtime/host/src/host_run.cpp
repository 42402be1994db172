// SPDX-License-Identifier: Apache-2.0
#include "rave/host/host_run.hpp"

#include <nlohmann/json.hpp>

#include "host_session.hpp"
#include "input_post.hpp"
#include "rave/base/file.hpp"
#include "rave/control/world_request.hpp"
#include "rave/protocol/host_port.hpp"
#include "rave/results/result_parts.hpp"
#include "world_account.hpp"

namespace rave::runtime {
namespace {

using lock_step::HostPort;

/// For another manager of a run that lost its own while this process stood still.
constexpr Duration kAfterStandstill = from_seconds(10);
/// How often it is looked whether who drives is still heard, while a step is waited for.
constexpr std::chrono::milliseconds kDriveLook{10};

/// Above all that an earlier process of this host has used.
std::uint64_t unique_number() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
}

/// The environment manager has the world: a report goes there, and the world of the next step comes
/// back.
class SteppedExchange final : public HostExchange {
 public:
  SteppedExchange(RunSession& run, HostPort& port, const HostSetup& host)
      : run_(run),
        port_(port),
        host_(host),
        account_(host.scenario, run.engine.spec()),
        post_(run.engine, host.part.number, unique_number(), &run.console) {
    report_.host = host.part.number;
    run.forwarder = &post_;
    run.observers.forward_to(&post_);
  }
  SteppedExchange(const SteppedExchange&) = delete;
  SteppedExchange& operator=(const SteppedExchange&) = delete;
  ~SteppedExchange() override {
    run_.observers.forward_to(nullptr);
    run_.forwarder = nullptr;
  }

  Result<bool> begin() override {
    RAVE_TRY(propose());
    return true;
  }
  Result<bool> await_turn() override;
  Status step() override {
    RAVE_TRY(run_.engine.join(world_, port_.authority()));
    return propose();
  }
  void step_done() override {
    look_back(run_, obstacle_events(world_));
    keep_roster(port_.roster(), run_.engine, run_.observers, run_.console);
    account_.after_step(run_.engine);
    port_.show(run_.engine, host_.part.robots);
  }
  const std::optional<lock_step::RunEnding>& ending() const override { return port_.ending(); }
  void complete(RunFacts& facts) override;
  void describe(nlohmann::ordered_json& json, const HostOutcome& outcome,
                const RunFacts& /*facts*/) const override {
    json["steps"] = outcome.steps;
    json["hash_part"] = fmt::format("{:016x}", run_.engine.hash().value());
  }
  Status deliver(std::span<const std::byte> host_results) override {
    return port_.deliver(host_results);
  }

 private:
  Status propose();
  Result<HostPort::Answer> exchange();
  void serve();
  void note_gap();

  RunSession& run_;
  HostPort& port_;
  const HostSetup& host_;
  WorldAccount account_;
  InputPost post_;
  sim::HostReport report_;
  sim::WorldStep world_;
  bool came_to_end_ = false;
  std::uint64_t joined_at_ = 0;  ///< After the last gap, if there was one.
};

Status SteppedExchange::propose() {
  Status status = run_.engine.propose(report_);
  // The others shall know why.
  if (!status) port_.farewell(report_, run_.engine.hash().value());
  // What this host refuses of the step that is done it says in this report.
  if (post_.settle(report_.refusals)) port_.serve();
  post_.put(report_);
  return status;
}

/// A process may have made a request, or fallen silent.
void SteppedExchange::serve() {
  serve_requests(run_);
  post_.put(report_);
}

Result<HostPort::Answer> SteppedExchange::exchange() {
  const auto meanwhile = [this] {
    look_on_while_held(run_);
    port_.show_rest(run_.engine, host_.part.robots);
    serve();
    post_.put_off(port_.waits_for(), report_.step, InputPost::Clock::now());
    tell_roster(port_.roster(), run_.engine, run_.observers, run_.console);
    return run_.stopping();
  };
  const auto look = [this] {
    HostPort::Look next;
    if (run_.observers.drives()) next.within = kDriveLook;
    if (run_.options.control != nullptr) next.asked = run_.options.control->asked();
    return next;
  };
  return port_.exchange(report_, run_.engine.hash().value(), world_, meanwhile, look);
}

/// The run continued without this host.
void SteppedExchange::note_gap() {
  std::string text = fmt::format("was absent from step {} to step {}", report_.step, world_.step);
  run_.console.warn("host", "{}; its robots continue where they stand", text);
  // Orders of people are for the moment in which they are given.
  post_.drop("the run continued without the host of the robot");
  run_.problems.push_back(std::move(text));
  joined_at_ = world_.step;
}

Result<bool> SteppedExchange::await_turn() {
  serve();
  run_.stopped = run_.stopping();
  if (run_.stopped) return false;
  RAVE_TRY_ASSIGN(const HostPort::Answer answer, exchange());
  run_.stopped = answer == HostPort::Answer::kStopped;
  run_.ended = answer == HostPort::Answer::kEnded;
  if (answer != HostPort::Answer::kWorld) return false;
  account_.take(world_, port_.authority());
  post_.take(world_);
  if (world_.step > report_.step) note_gap();
  came_to_end_ = world_.last;
  if (came_to_end_) return false;
  // What was asked of the world by hand counts from this step on.
  for (const request::Request& request : requests_in(run_.engine.spec(), world_)) {
    run_.observers.keep(request, world_.step);
  }
  run_.step = world_.step;
  return true;
}

/// Changes what the engine shows of robots.
void SteppedExchange::complete(RunFacts& facts) {
  post_.drop("the run has ended");
  facts.first_step = joined_at_;
  // A manager that took over does not know what was before.
  if (port_.changed_hands()) {
    WorldFacts told = account_.facts();
    // Who was not there all along cannot fill the gap of a manager.
    if (told.first_step == 0) facts.world = std::move(told);
  }
  if (!came_to_end_ || !has_radio(run_.engine.spec())) return;
  // Who hears what was sent in the last step is decided with the world after it.
  const bool heard = run_.engine.join(world_, port_.authority()).has_value();
  if (heard) facts.radio = run_.engine.radio_counts();
}

Result<HostOutcome> run_stepped_host(const HostSetup& host, BuiltScenario& built) {
  built.spec.live_clock = nullptr;
  host.pace.set_factor(0);
  for (const std::string& note : built.notes) host.console.warn("scenario", "{}", note);
  const HostOptions& options = host.options;
  lock_step::Identity self{host.part.number, options.host,
                           static_cast<std::uint32_t>(host.part.robots.size()),
                           shared_number(host.scenario), interface_stamp()};
  self.real_robots = real_robots(built.spec, host.part.robots);
  self.folder = kept_folder(options.run);
  std::function<void()> on_step_done;
  built.spec.on_step_done = [&on_step_done] { on_step_done(); };
  RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(built.spec)));
  const config::ScenarioFile& file = host.scenario.scenario;
  HostPort::Patience patience{options.manager_patience, {}};
  // The others may have continued the run, and ended it, while this process stood still.
  if (file.on_lost_host != config::LostHost::kWait) patience.after_standstill = kAfterStandstill;
  RAVE_TRY_ASSIGN(const auto port,
                  HostPort::open(options.bus, std::move(self), &host.console, patience,
                                 options.begin_request, options.begin_command));
  port->word().describe(file.name.value, steps_of(file), file.step_s.value);
  introduce_robots(port->roster(), engine->spec(), host.part.robots, host.console);
  const auto make = [&](RunSession& run, const BusFace& /*face*/) {
    return std::make_unique<SteppedExchange>(run, *port, host);
  };
  return run_session(host, *engine, port->bus(), make, on_step_done);
}

}  // namespace

Result<HostOutcome> run_host(const config::ExpandedScenario& scenario, plugin::Catalogue& catalogue,
                             HostOptions options) {
  RAVE_TRY_ASSIGN(const HostPart part, find_host_part(scenario, options.host));
  const RunOptions& run = options.run;
  const std::string expanded = config::write_expanded(scenario);
  RAVE_TRY(write_private_file_atomically(run.output / "scenario.yaml", expanded));
  ConsoleTee console(run.log);
  BuildOptions how{run.program_runner, &console};
  how.local = part.robots;
  how.others = options.others.get();
  WallPace pace(1);
  how.live_clock = &pace;
  config::ExpandedScenario adjusted = scenario;
  keep_history_for_observers(adjusted.scenario);
  RAVE_TRY_ASSIGN(BuiltScenario built, build(adjusted, catalogue, how));
  options.others.reset();
  const HostSetup host{scenario, expanded, catalogue, options, part, console, pace, built};
  return built.live_reason.empty() ? run_stepped_host(host, built) : run_live_host(host, built);
}

}  // namespace rave::runtime
