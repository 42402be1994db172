// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/live_run.hpp"

#include <optional>

#include "live/live_feed.hpp"
#include "live/live_source.hpp"

namespace rave::gui_server {
namespace {

const char* const kHeldByNobody =
    "A run with real robots cannot be paused: the real world continues.";

}  // namespace

struct LiveRun::Impl {
  Status begin(const runtime::RunView& run) {
    RAVE_TRY_ASSIGN(auto start,
                    LiveSource::Start::of(scenario, run.info, run.hybrids, run.engine.spec()));
    start.about.started = run.info.started;
    start.about.lock_step = !run.live;
    // The server is in the process of the host: there is no shorter way.
    start.about.relay = true;
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
  std::shared_ptr<LiveBox> box = std::make_shared<LiveBox>();
  std::shared_ptr<LiveSource> source{};
  std::optional<LiveFeed> feed{};
};

LiveRun::LiveRun(const config::ExpandedScenario& scenario, runtime::RunControl& control,
                 plugin::Catalogue& catalogue, std::unique_ptr<plugin::Catalogue> described,
                 std::function<void(std::shared_ptr<Source>)> ready, std::filesystem::path file)
    : impl_(new Impl{scenario, control, std::move(described), std::move(ready), std::move(file)}) {
  impl_->feed.emplace(impl_->box, catalogue, [impl = impl_.get()](const runtime::RunView& run) {
    return impl->begin(run);
  });
}

LiveRun::~LiveRun() = default;

runtime::RunObserver& LiveRun::observer() noexcept { return *impl_->feed; }

void LiveRun::end(std::string reason) {
  if (impl_->source) impl_->source->end(std::move(reason));
}

}  // namespace rave::gui_server
