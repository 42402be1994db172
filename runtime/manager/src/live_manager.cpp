// SPDX-License-Identifier: Apache-2.0
#include "rave/manager/live_manager.hpp"

#include "live_run.hpp"

namespace rave::manager {

Result<LiveManagerOutcome> manage_live(sim::EngineSpec spec, const LiveManagerOptions& options) {
  RAVE_TRY_ASSIGN(auto hosts, LiveHosts::open(options));
  RAVE_TRY_ASSIGN(auto edits, LiveEdits::create(std::move(spec), options, *hosts));
  LiveRun run(options, std::move(hosts), std::move(edits));
  return run.go();
}

}  // namespace rave::manager
