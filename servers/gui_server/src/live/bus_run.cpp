// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/bus_run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <array>

#include "live/bus_feed.hpp"
#include "live/bus_port.hpp"
#include "live/live_source.hpp"
#include "rave/bus/topics.hpp"
#include "rave/recording/describe_run.hpp"
#include "rave/watch/observer.hpp"
#include "replay/kept_recordings.hpp"

namespace rave::gui_server {
namespace {

/// As long as a machine's name is in an introduction.
constexpr std::size_t kMachineBytes = sizeof(bus::HostInfo::machine);

/// A source that belongs together with the thread that feeds it.
class BusSource final : public LiveSource {
 public:
  BusSource(Start start, const std::shared_ptr<LiveBox>& box, std::unique_ptr<RunPort> port,
            std::unique_ptr<watch::Observer> observer, onlook::Listener listener,
            BusFeed::World world, BusFeed::OnOver on_over)
      : LiveSource(std::move(start), box, std::move(port)),
        feed_(std::move(observer), std::move(listener), box, std::move(world), std::move(on_over)) {
  }
  [[nodiscard]] Status start_feed() { return feed_.start(); }

 private:
  BusFeed feed_;
};

BusFeed::World world_of(const config::ExpandedScenario& scenario,
                        const runtime::BuiltScenario& built) {
  BusFeed::World world;
  world.robots = scenario.robots.size();
  const world::WorldModel& model = built.spec.world;
  for (std::size_t o = 0; o < model.obstacle_count(); ++o) {
    const std::uint32_t id = model.obstacle_id(o);
    world.obstacles.emplace(id, *model.obstacle(id));
  }
  return world;
}

Result<std::unique_ptr<BusPort>> port_to_hosts(const config::ExpandedScenario& scenario,
                                               const runtime::BuiltScenario& built,
                                               const bus::BusConfig& bus) {
  std::vector<std::string> names;
  for (const sim::RobotSpec& robot : built.spec.robots) names.push_back(robot.name);
  RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(scenario));
  std::map<std::string, std::string> host_of;
  for (const config::PlannedHost& host : hosts) {
    for (const std::size_t robot : host.robots) host_of[names[robot]] = host.name;
  }
  return BusPort::open(bus, built.live_reason.empty(), names, std::move(host_of));
}

BusFeed::OnOver replays(OnOver on_over) {
  if (!on_over) return {};
  return [on_over = std::move(on_over)](const std::vector<watch::KeptAt>& kept) -> std::string {
    std::array<char, kMachineBytes> machine{};
    if (::gethostname(machine.data(), machine.size() - 1) != 0) machine.front() = '\0';
    auto replay = open_kept(kept, machine.data());
    if (replay) {
      on_over(*std::move(replay), "");
      return {};
    }
    // If they are elsewhere, the text says where; otherwise why they cannot be played.
    const bool elsewhere = replay.error().code == ErrorCode::kNotFound;
    std::string where = elsewhere ? replay.error().message
                                  : fmt::format("{} They cannot be played: {}.", places_of(kept),
                                                replay.error().text());
    on_over(nullptr, where);
    return where;
  };
}

}  // namespace

Result<std::shared_ptr<Source>> watch_run(const config::ExpandedScenario& scenario,
                                          const runtime::BuiltScenario& built, bus::BusConfig bus,
                                          std::unique_ptr<plugin::Catalogue> described,
                                          runtime::RunControl* control,
                                          const std::filesystem::path& file, OnOver on_over) {
  // The manager of the run may be in this process, with a bus of its own.
  bus.beside = true;
  bus.side = bus::Side::kMonitor;
  RAVE_TRY_ASSIGN(auto observer, watch::Observer::open(bus));
  RAVE_TRY_ASSIGN(auto listener, onlook::Listener::create(observer->bus()));
  RAVE_TRY_ASSIGN(auto hosts, port_to_hosts(scenario, built, bus));
  const bool managed = control != nullptr && built.live_reason.empty();
  std::unique_ptr<RunPort> port;
  if (managed) {
    port = std::make_unique<ManagedPort>(*control, std::move(hosts));
  } else {
    port = std::move(hosts);
  }
  const runtime::DescribedRun run = runtime::describe_run(built);
  RAVE_TRY_ASSIGN(auto start, LiveSource::Start::of(scenario, run.info, run.hybrids, built.spec));
  start.about.lock_step = built.live_reason.empty();
  start.scenario = file;
  if (described) {
    start.probes = std::make_shared<ProbeDesk>(std::move(described), start.about.step_s);
  }
  // Who manages the run serves its page: without this process there is no run either.
  start.about.relay = managed || scenario.scenario.gui.relay;
  auto source = std::make_shared<BusSource>(
      std::move(start), std::make_shared<LiveBox>(), std::move(port), std::move(observer),
      std::move(listener), world_of(scenario, built), replays(std::move(on_over)));
  RAVE_TRY(source->start_feed());
  return source;
}

}  // namespace rave::gui_server
