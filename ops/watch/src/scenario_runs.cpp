// SPDX-License-Identifier: Apache-2.0
#include "rave/watch/scenario_runs.hpp"

#include <algorithm>
#include <chrono>
#include <functional>
#include <map>

#include "rave/base/control_characters.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/wait_set.hpp"

namespace rave::watch {
namespace {

using Clock = std::chrono::steady_clock;

/// How long others may follow the first that is wanted.
constexpr std::chrono::milliseconds kForNewer{400};
/// Bounds the memory if runs are forged.
constexpr std::size_t kMostRuns = 1000;

/// What processes of all runs say of themselves.
struct Search {
  std::unique_ptr<bus::Bus> bus;
  bus::Reader<bus::HostInfo> infos;
  bus::Reader<bus::HostRun> words;
  bus::WaitSet waits;
  std::map<std::string, ScenarioRun> runs{};  ///< By number.

  Status open(const bus::BusConfig& config) {
    RAVE_TRY_ASSIGN(bus, bus::Bus::open(config));
    RAVE_TRY(bus::open_all(*bus, infos, words));
    RAVE_TRY_ASSIGN(waits, bus::WaitSet::create(*bus));
    return waits.add(infos, words);
  }
  ScenarioRun* run_of(const std::uint8_t (&bytes)[16]) {
    bus::RunId id;
    std::ranges::copy(bytes, id.bytes.begin());
    if (runs.size() >= kMostRuns && !runs.contains(id.text())) return nullptr;
    ScenarioRun& run = runs[id.text()];
    run.run = id;
    return &run;
  }
  /// Whether one that is new is wanted.
  bool look(const IsWanted& wanted) {
    bool any = false;
    infos.take([&](const bus::HostInfo& info) {
      ScenarioRun* const run = run_of(info.run);
      if (run == nullptr) return;
      run->number = info.scenario;
      run->started_ns = std::max<std::int64_t>(run->started_ns, info.started_ns);
      any = wanted(*run) || any;
    });
    words.take([&](const bus::HostRun& state) {
      ScenarioRun* const run = run_of(state.run);
      std::string text = without_control_characters(state.scenario, " ");
      if (run == nullptr || run->scenario == text) return;
      run->scenario = std::move(text);
      any = wanted(*run) || any;
    });
    return any;
  }
};

}  // namespace

Result<std::vector<ScenarioRun>> find_scenario_runs(bus::BusConfig config, Duration patience,
                                                    const IsWanted& wanted,
                                                    const std::stop_token& stop) {
  config.run = {};
  config.anonymous = true;
  config.all_runs = true;
  // Who looks on talks to hosts alone.
  config.side = bus::Side::kMonitor;
  Search search;
  RAVE_TRY(search.open(config));
  auto end = Clock::now() + std::chrono::nanoseconds(patience.ns);
  while (!stop.stop_requested() && Clock::now() < end) {
    if (search.look(wanted)) end = std::min(end, Clock::now() + kForNewer);
    static_cast<void>(search.waits.wait(bus::left_until(end), stop));
  }
  std::vector<ScenarioRun> found;
  for (auto& [number, run] : search.runs) found.push_back(std::move(run));
  std::ranges::stable_sort(found, std::greater(), &ScenarioRun::started_ns);
  return found;
}

}  // namespace rave::watch
