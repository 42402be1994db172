// SPDX-License-Identifier: Apache-2.0
#include "bus_search.hpp"

#include <string_view>

#include "rave/watch/observer.hpp"

namespace rave::cli {
namespace {

/// Whether a run is of this scenario, as its manager says.
Result<bool> is_of(bus::BusConfig config, const watch::FoundRun& run, std::string_view scenario,
                   const std::stop_token& stop) {
  config.run = run.run;
  RAVE_TRY_ASSIGN(const auto observer, watch::Observer::open(config));
  constexpr int kLooks = 15;
  for (int look = 0; look < kLooks && !stop.stop_requested(); ++look) {
    observer->watch(from_seconds(0.1), stop);
    const std::string found = observer->view(false).scenario;
    if (!found.empty()) return found == scenario;
  }
  return false;
}

}  // namespace

Result<bus::RunId> find_bus_run(const bus::BusConfig& config, const std::string& word,
                                Duration patience, const std::stop_token& stop) {
  RAVE_TRY_ASSIGN(const auto found, watch::find_runs(config, patience, stop));
  auto chosen = watch::choose_run(found, word);
  if (chosen || word.empty()) return chosen;
  for (const watch::FoundRun& run : found) {
    RAVE_TRY_ASSIGN(const bool fits, is_of(config, run, word, stop));
    if (fits) return run.run;
  }
  return chosen;
}

}  // namespace rave::cli
