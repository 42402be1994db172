// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/bus_run.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "bus_port.hpp"
#include "components.hpp"
#include "live_source.hpp"
#include "rave/recording/describe_run.hpp"
#include "rave/watch/observer.hpp"
#include "scenario_rights.hpp"
#include "scene_json.hpp"

namespace rave::gui_server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Duration kWatched = from_seconds(0.033);
constexpr Duration kUnwatched = from_seconds(0.25);
constexpr auto kHostsInterval = std::chrono::seconds(1);

PlayState standing_of(const watch::RunView& view) {
  PlayState state;
  state.reason = view.text;
  state.speed = view.speed.value_or(0);
  switch (view.phase) {
    case watch::Phase::kGoes:
      state.kind = PlayState::Kind::kRunning;
      break;
    case watch::Phase::kPaused:
      state.kind = PlayState::Kind::kPaused;
      break;
    case watch::Phase::kEnded:
    case watch::Phase::kFailed:
      state.kind = PlayState::Kind::kEnded;
      break;
    case watch::Phase::kGathers:
    case watch::Phase::kWaits:
      state.kind = PlayState::Kind::kWaiting;
      break;
    case watch::Phase::kUnknown: {
      // Hosts in real time may have no manager.
      const bool here =
          std::any_of(view.hosts.begin(), view.hosts.end(), [](const watch::HostView& host) {
            return !host.manager && host.standing == watch::Standing::kHere;
          });
      state.kind = here ? PlayState::Kind::kRunning : PlayState::Kind::kWaiting;
      if (!here && state.reason.empty()) state.reason = "No process of this run is there.";
      break;
    }
  }
  return state;
}

const char* word_of(watch::Standing standing) {
  switch (standing) {
    case watch::Standing::kHere:
      return "here";
    case watch::Standing::kWaiting:
    case watch::Standing::kLate:
      return "late";
    case watch::Standing::kGone:
    case watch::Standing::kDropped:
      return "gone";
  }
  return "gone";
}

template <class T>
nlohmann::json or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

std::string hosts_json(const watch::RunView& view) {
  nlohmann::json hosts = nlohmann::json::array();
  for (const watch::HostView& host : view.hosts) {
    const std::uint32_t robots = host.robots.value_or(0);
    const std::uint32_t real = std::min(robots, host.real_robots.value_or(0));
    hosts.push_back({{"name", host.manager ? "manager" : host.name},
                     {"machine", host.machine},
                     {"state", word_of(host.standing)},
                     {"late_s", host.behind_s.value_or(0)},
                     {"real", real},
                     {"simulated", robots - real},
                     {"step", host.step.value_or(0)},
                     {"steps_per_s", host.rate_hz.value_or(0)},
                     {"delay_s", or_null(host.delay_s)},
                     {"cpu", or_null(host.cores)},
                     {"lost", host.lost.value_or(0)}});
  }
  return hosts.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Looks on in a thread of its own, and hands over what it sees.
class BusFeed {
 public:
  BusFeed(std::unique_ptr<watch::Observer> observer, std::shared_ptr<LiveBox> box,
          std::size_t robots)
      : observer_(std::move(observer)),
        box_(std::move(box)),
        robots_(robots),
        thread_([this](const std::stop_token& stop) { work(stop); }) {}

 private:
  void work(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      observer_->watch(box_->watched.load(std::memory_order_relaxed) ? kWatched : kUnwatched, stop);
      draw(observer_->view(true));
    }
  }

  void draw(const watch::RunView& view) {
    LivePicture& picture = box_->pictures.draft();
    if (++serial_ == 0) ++serial_;
    picture.poses.serial = serial_;
    picture.poses.time_s = view.time_s.value_or(0);
    picture.poses.step = view.step.value_or(0);
    picture.poses.robots.assign(robots_, RobotState{});
    for (const watch::RobotView& robot : view.robots) {
      if (robot.number >= robots_ || !robot.x_m) continue;
      RobotState& state = picture.poses.robots[robot.number];
      state = {*robot.x_m, robot.y_m.value_or(0), robot.yaw_rad.value_or(0),
               robot.speed_mps.value_or(0), kKnown};
      if (robot.stale) state.flags |= kStale;
      if (robot.simulated == false) state.flags |= kReal;
    }
    picture.reading_count = 0;
    picture.standing = standing_of(view);
    if (const auto now = Clock::now(); now >= next_hosts_) {
      next_hosts_ = now + kHostsInterval;
      hosts_ = hosts_json(view);
      ++hosts_revision_;
    }
    picture.hosts = hosts_;
    picture.hosts_revision = hosts_revision_;
    box_->pictures.publish();
  }

  std::unique_ptr<watch::Observer> observer_;
  std::shared_ptr<LiveBox> box_;
  std::size_t robots_;
  std::uint32_t serial_ = 0;
  Clock::time_point next_hosts_{};
  std::string hosts_ = "[]";
  std::uint64_t hosts_revision_ = 0;
  std::jthread thread_;  ///< Last, so that it ends first.
};

/// A source that belongs together with the thread that feeds it.
class BusSource final : public LiveSource {
 public:
  BusSource(Start start, const std::shared_ptr<LiveBox>& box, std::unique_ptr<RunPort> port,
            std::unique_ptr<watch::Observer> observer, std::size_t robots)
      : LiveSource(std::move(start), box, std::move(port)),
        feed_(std::move(observer), box, robots) {}

  [[nodiscard]] Powers powers() const override {
    Powers powers = LiveSource::powers();
    const char* const not_sent = "Readings are not sent over the bus; see them in the recording.";
    for (const char* const word : {"readings", "hybrid_parts"}) {
      std::erase(powers.may, word);
      powers.why_not[word] = not_sent;
    }
    return powers;
  }

 private:
  BusFeed feed_;
};

Result<LiveSource::Start> start_of(const config::ExpandedScenario& scenario,
                                   const runtime::BuiltScenario& built) {
  const runtime::DescribedRun run = runtime::describe_run(built);
  LiveSource::Start start;
  start.about.live = true;
  start.about.name = scenario.scenario.name.value;
  start.about.step_s = run.info.step_s;
  start.about.seed = run.info.seed;
  start.about.lock_step = built.live_reason.empty();
  start.about.duration_s = scenario.scenario.duration_s;
  start.about.relay = scenario.scenario.gui.relay;
  start.about.rights = rights_of(scenario.scenario.gui);
  RAVE_TRY_ASSIGN(start.about.components, components_of(scenario.scenario.gui));
  start.robots_json = robots_of(scenario, run.info, run.hybrids);
  for (const record::RecordedRobot& robot : run.info.robots) start.robots.push_back(robot.name);
  const world::WorldModel& world = built.spec.world;
  for (std::size_t o = 0; o < world.obstacle_count(); ++o) {
    const std::uint32_t id = world.obstacle_id(o);
    start.bodies.emplace_back(id, body_json(id, *world.obstacle(id)));
  }
  return start;
}

}  // namespace

Result<std::shared_ptr<Source>> watch_run(const config::ExpandedScenario& scenario,
                                          const runtime::BuiltScenario& built, bus::BusConfig bus,
                                          runtime::RunControl* control) {
  // The manager of the run may be in this process, with a bus of its own.
  bus.beside = true;
  RAVE_TRY_ASSIGN(auto observer, watch::Observer::open(bus));
  std::unique_ptr<RunPort> port;
  if (control != nullptr && built.live_reason.empty()) {
    port = std::make_unique<LocalPort>(*control, "");
  } else {
    RAVE_TRY_ASSIGN(auto asker, control::BusRun::open(bus, "GUI Server"));
    RAVE_TRY_ASSIGN(auto status, control::BusRun::open(bus, "GUI Server"));
    std::vector<std::string> names;
    for (const sim::RobotSpec& robot : built.spec.robots) names.push_back(robot.name);
    RAVE_TRY_ASSIGN(auto commands, CommandLine::open(bus, names));
    port = std::make_unique<BusPort>(std::move(asker), std::move(status), std::move(commands));
  }
  RAVE_TRY_ASSIGN(auto start, start_of(scenario, built));
  // In lock-step the manager takes the orders; beside it there is no shorter way.
  if (control != nullptr && start.about.lock_step) start.about.relay = true;
  return std::make_shared<BusSource>(std::move(start), std::make_shared<LiveBox>(), std::move(port),
                                     std::move(observer), scenario.robots.size());
}

}  // namespace rave::gui_server
