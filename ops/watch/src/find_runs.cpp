// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <functional>
#include <map>

#include "rave/base/names.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/watch/observer.hpp"

namespace rave::watch {
namespace {

using Clock = std::chrono::steady_clock;

/// After this time without a new process, all near ones have answered.
constexpr std::chrono::milliseconds kMoment{400};
/// A word with fewer digits could as well be a name.
constexpr std::size_t kFewestDigits = 4;

std::vector<FoundRun> runs_of(const std::vector<bus::BusProcess>& processes) {
  std::map<std::string, FoundRun> runs;
  for (const bus::BusProcess& process : processes) {
    if (process.run.none()) continue;
    FoundRun& run = runs[process.run.text()];
    run.run = process.run;
    run.processes.push_back(process.name);
  }
  std::vector<FoundRun> found;
  for (auto& [number, run] : runs) {
    std::ranges::sort(run.processes);
    found.push_back(std::move(run));
  }
  std::ranges::stable_sort(found, std::greater(),
                           [](const FoundRun& r) { return r.processes.size(); });
  return found;
}

}  // namespace

std::string list_of(const std::vector<FoundRun>& runs) {
  std::string text;
  for (const FoundRun& run : runs) {
    const std::vector<std::string_view> names(run.processes.begin(), run.processes.end());
    text += fmt::format("{}{} (of {})", text.empty() ? "" : "; ", run.run.text().substr(0, 8),
                        join_names(names));
  }
  return text;
}

Result<std::vector<FoundRun>> find_runs(bus::BusConfig config, Duration patience,
                                        const Enough& enough, const std::stop_token& stop) {
  // Without a run the bus exchanges no samples and only sees who is in the domain; only a monitor
  // may do so.
  config.run = {};
  config.anonymous = true;
  RAVE_TRY_ASSIGN(auto bus, bus::Bus::open(config));
  RAVE_TRY_ASSIGN(auto waits, bus::WaitSet::create(*bus));
  RAVE_TRY(waits.add_events());
  const auto latest = Clock::now() + std::chrono::nanoseconds(patience.ns);
  auto end = latest;
  std::size_t known = 0;
  for (;;) {
    static_cast<void>(bus->take_events());
    const std::vector<bus::BusProcess> all = bus->processes();
    // With certificates a process appears first and says its run later.
    const auto processes = static_cast<std::size_t>(
        std::ranges::count_if(all, [](const auto& process) { return !process.run.none(); }));
    if (processes > known) {
      known = processes;
      const auto found = runs_of(all);
      // Discovery has no end. So wait until the wanted run is found, or until no new process has
      // appeared for a moment.
      if (enough && enough(found)) break;
      if (!enough && !found.empty()) end = std::min(latest, Clock::now() + kMoment);
    }
    const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(end - Clock::now());
    if (left.count() <= 0 || stop.stop_requested()) break;
    static_cast<void>(waits.wait(Duration{left.count()}, stop));
  }
  return runs_of(bus->processes());
}

bool is_named(const bus::RunId& run, std::string_view word) {
  return run == bus::run_of_name(word) || run.text() == word;
}

bool is_called(const bus::RunId& run, std::string_view word) {
  return is_named(run, word) || (word.size() >= kFewestDigits && run.text().starts_with(word));
}

Result<bus::RunId> choose_run(const std::vector<FoundRun>& found, std::string_view word) {
  if (found.empty())
    return fail(ErrorCode::kNotFound, "no run of several processes is in progress");
  if (word.empty()) {
    if (found.size() == 1) return found.front().run;
    return fail(ErrorCode::kNotFound, "{} runs are in progress; name one: {}", found.size(),
                list_of(found));
  }
  std::vector<FoundRun> fitting;
  for (const FoundRun& run : found) {
    if (is_named(run.run, word)) return run.run;
    if (is_called(run.run, word)) fitting.push_back(run);
  }
  if (fitting.size() == 1) return fitting.front().run;
  if (!fitting.empty()) {
    return fail(ErrorCode::kNotFound, "the numbers of several runs begin with `{}`: {}", word,
                list_of(fitting));
  }
  return fail(ErrorCode::kNotFound, "there is no run `{}`; runs in progress: {}", word,
              list_of(found));
}

}  // namespace rave::watch
