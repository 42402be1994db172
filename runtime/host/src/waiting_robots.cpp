// SPDX-License-Identifier: Apache-2.0
#include "waiting_robots.hpp"

#include "rave/control/requests.hpp"

namespace rave::runtime {

void tell_who_waits(sim::Engine& engine, const RunOptions& options, LogSink& log) {
  const std::string names = unarmed_robots(engine);
  if (names.empty()) return;
  if (options.arm) {
    engine.arm(RobotId(), sim::Author::kRun);
    log.warn("run", "armed from the start: {}", names);
    return;
  }
  const std::string& run = options.run_name;
  log.warn("run", "{} will stand until armed: `rave arm{}{}` in another terminal", names,
           run.empty() ? "" : " ", run);
}

}  // namespace rave::runtime
