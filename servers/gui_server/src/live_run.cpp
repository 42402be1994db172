// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/live_run.hpp"

#include "components.hpp"
#include "live_feed.hpp"
#include "live_source.hpp"
#include "parameters_json.hpp"
#include "scenario_rights.hpp"
#include "scene_json.hpp"

namespace rave::gui_server {
namespace {

const char* const kHeldByNobody =
    "A run with real robots cannot be paused: the real world continues.";

}  // namespace

struct LiveRun::Impl {
  Impl(const config::ExpandedScenario& of, runtime::RunControl& with, plugin::Catalogue& catalogue,
       std::unique_ptr<plugin::Catalogue> of_server,
       std::function<void(std::shared_ptr<Source>)> call, std::filesystem::path of_scenario)
      : scenario(of),
        control(with),
        described(std::move(of_server)),
        ready(std::move(call)),
        file(std::move(of_scenario)),
        box(std::make_shared<LiveBox>()),
        feed(box, catalogue, [this](const runtime::RunView& run, auto bodies) {
          return begin(run, std::move(bodies));
        }) {}

  Status begin(const runtime::RunView& run,
               std::vector<std::pair<std::uint32_t, std::string>> bodies) {
    LiveSource::Start start;
    start.about.live = true;
    start.about.name = run.info.scenario;
    start.about.started = run.info.started;
    start.about.step_s = run.info.step_s;
    start.about.seed = run.info.seed;
    start.about.lock_step = !run.live;
    start.about.duration_s = scenario.scenario.duration_s;
    // The server is in the process of the host: there is no shorter way.
    start.about.relay = true;
    start.about.rights = rights_of(scenario.scenario.gui);
    RAVE_TRY_ASSIGN(start.about.components, components_of(scenario.scenario.gui));
    start.robots_json =
        with_parameters(robots_of(scenario, run.info, run.hybrids), run.engine.spec());
    for (const record::RecordedRobot& robot : run.info.robots) start.robots.push_back(robot.name);
    start.bodies = std::move(bodies);
    start.scenario = file;
    if (described) {
      start.probes = std::make_shared<ProbeDesk>(std::move(described), run.info.step_s);
    }
    source = std::make_shared<LiveSource>(
        std::move(start), box, std::make_unique<LocalPort>(control, run.live ? kHeldByNobody : ""));
    ready(source);
    return {};
  }

  const config::ExpandedScenario& scenario;
  runtime::RunControl& control;
  std::unique_ptr<plugin::Catalogue> described;
  std::function<void(std::shared_ptr<Source>)> ready;
  std::filesystem::path file;
  std::shared_ptr<LiveBox> box;
  std::shared_ptr<LiveSource> source;
  LiveFeed feed;
};

LiveRun::LiveRun(const config::ExpandedScenario& scenario, runtime::RunControl& control,
                 plugin::Catalogue& catalogue, std::unique_ptr<plugin::Catalogue> described,
                 std::function<void(std::shared_ptr<Source>)> ready, std::filesystem::path file)
    : impl_(std::make_unique<Impl>(scenario, control, catalogue, std::move(described),
                                   std::move(ready), std::move(file))) {}

LiveRun::~LiveRun() = default;

runtime::RunObserver& LiveRun::observer() noexcept { return impl_->feed; }

void LiveRun::end(std::string reason) {
  if (impl_->source) impl_->source->end(std::move(reason));
}

}  // namespace rave::gui_server
