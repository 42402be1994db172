// SPDX-License-Identifier: Apache-2.0
#include "rave/recording/world_record.hpp"

#include "rave/record/robot_ranges.hpp"
#include "rave/recording/provenance.hpp"
#include "rave/recording/record_keeper.hpp"

namespace rave::runtime {

Result<record::StringMap> hosts_for_record(const config::ExpandedScenario& scenario) {
  RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(scenario));
  record::StringMap all;
  for (const config::PlannedHost& host : hosts) {
    std::vector<std::uint32_t> robots(host.robots.begin(), host.robots.end());
    all[host.name] = record::robot_ranges(std::move(robots));
  }
  return all;
}

Result<std::unique_ptr<WorldRecord>> WorldRecord::begin(const std::filesystem::path& path,
                                                        const config::ExpandedScenario& scenario,
                                                        const sim::EngineSpec& spec,
                                                        const BodyKinds& kinds, LogSink* log) {
  record::RunInfo info = info_of(spec, kinds);
  info.scenario = scenario.scenario.name.value;
  info.expanded_scenario = config::write_expanded(scenario);
  add_maps(scenario, info);
  RAVE_TRY_ASSIGN(auto recorder, record::RunRecorder::open(path, info, {}, log));
  // Tells the merge that this part is that of the manager.
  RAVE_TRY(recorder.describe(record::kHostMetadata, {{"world", "all"}}));
  RAVE_TRY_ASSIGN(const auto hosts, hosts_for_record(scenario));
  RAVE_TRY(recorder.describe(record::kHostsMetadata, hosts));
  return std::unique_ptr<WorldRecord>(new WorldRecord(std::move(recorder), spec.step));
}

void WorldRecord::step(std::uint64_t step, const BodyKinds& kinds,
                       std::span<const sim::Event> events, std::uint64_t hash) {
  recorder_.begin_step(step, SimTime{static_cast<std::int64_t>(step) * step_.ns});
  record_events(kinds, events, recorder_);
  static_cast<void>(recorder_.hash(hash));
  static_cast<void>(recorder_.end_step());
}

void WorldRecord::say(const request::Request& chat, std::uint64_t step) {
  record_chat(chat, step, recorder_);
}

}  // namespace rave::runtime
