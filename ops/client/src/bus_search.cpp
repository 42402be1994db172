// SPDX-License-Identifier: Apache-2.0
#include "rave/client/bus_search.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "rave/watch/observer.hpp"

namespace rave::client {
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

/// When the search for a run can end. A name or a whole number can be of one run alone; of anything
/// else there may be more than has been found.
watch::Enough enough_for(SearchFor what, const std::string& word) {
  if (what == SearchFor::kLook) return {};
  return [word](const std::vector<watch::FoundRun>& found) {
    return !word.empty() && std::ranges::any_of(found, [&word](const watch::FoundRun& run) {
      return watch::is_named(run.run, word);
    });
  };
}

}  // namespace

Duration search_patience(const bus::BusConfig& config) {
  // Shorter than that of `rave top`: who has mistyped the name of a run waits for it.
  const bool near = config.loopback() && config.peers.empty();
  return from_seconds(near ? 1.5 : 3);
}

Result<bus::RunId> find_bus_run(const bus::BusConfig& config, const std::string& word,
                                SearchFor what, Duration patience, const std::stop_token& stop) {
  RAVE_TRY_ASSIGN(const auto found,
                  watch::find_runs(config, patience, enough_for(what, word), stop));
  auto chosen = watch::choose_run(found, word);
  if (chosen || word.empty()) return chosen;
  std::vector<watch::FoundRun> fitting;
  for (const watch::FoundRun& run : found) {
    RAVE_TRY_ASSIGN(const bool fits, is_of(config, run, word, stop));
    if (fits) fitting.push_back(run);
  }
  if (fitting.size() == 1) return fitting.front().run;
  if (fitting.empty()) return chosen;
  return fail(ErrorCode::kNotFound, "several runs of `{}`: {}; name one by its number", word,
              watch::list_of(fitting));
}

}  // namespace rave::client
