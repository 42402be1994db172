// SPDX-License-Identifier: Apache-2.0
#include "rave/host/observer_list.hpp"

#include "rave/control/requests.hpp"
#include "rave/recording/provenance.hpp"
#include "rave/recording/world_record.hpp"
#include "rave/results/event_log.hpp"

namespace rave::runtime {

ObserverList::ObserverList(const Parts& parts)
    : console_(parts.console),
      results_(parts.scenario, parts.robot_kinds, parts.engine.spec(), parts.options.picture) {}

ObserverList::~ObserverList() { console_.attach(nullptr); }

Result<std::unique_ptr<ObserverList>> ObserverList::open(const Parts& parts) {
  std::unique_ptr<ObserverList> list(new ObserverList(parts));
  RAVE_TRY(list->open_all(parts));
  return list;
}

Status ObserverList::open_all(const Parts& parts) {
  const RunOptions& options = parts.options;
  RAVE_TRY_ASSIGN(ros2_, Ros2Face::open(parts.scenario, parts.engine, parts.host));
  if (parts.shadows) {
    RAVE_TRY_ASSIGN(shadows_,
                    Shadows::create(parts.scenario, parts.catalogue, parts.engine, &parts.console));
  }
  if (ros2_) others_.push_back(ros2_.get());
  if (shadows_) others_.push_back(shadows_.get());
  others_.insert(others_.end(), options.observers.begin(), options.observers.end());
  if (options.observers.empty() && !options.record) return {};
  record::RunInfo info = info_of(parts.engine, results_.kinds);
  info.scenario = parts.scenario.scenario.name.value;
  const record::StringMap hybrids = PartKeeper::describe(parts.engine.spec());
  for (RunObserver* const observer : others_) {
    RAVE_TRY(observer->run_begins({parts.engine, results_.kinds, info, hybrids, parts.live}));
  }
  if (!options.record) return {};
  info.expanded_scenario = parts.expanded;
  info.versions = versions_of(parts.engine.spec(), parts.catalogue);
  info.inputs = input_files(parts.scenario, parts.engine);
  RecordKeeper::About about{hybrids, !parts.live, parts.host};
  if (!parts.host.empty()) {
    RAVE_TRY_ASSIGN(about.hosts, hosts_for_record(parts.scenario));
  }
  RAVE_TRY_ASSIGN(record_, RecordKeeper::open(options.output / "run.mcap", parts.engine,
                                              results_.kinds, info, about, options.log));
  console_.attach(&record_->recorder());
  return {};
}

void ObserverList::after_step(const StepView& step) {
  results_.after_step(step);
  for (RunObserver* const observer : others_) observer->after_step(step);
}

void ObserverList::held(const sim::Engine& engine) {
  for (RunObserver* const observer : others_) observer->held(engine);
}

void ObserverList::keep(const StepView& step) {
  if (!record_) return;
  record_->after_step(step);
  record_->keep(step.beside);
  record_->keep(results_.events());
  for (const RunObserver* const observer : others_) {
    record_->keep(observer->events());
    observer->record(record_->recorder());
  }
}

void ObserverList::tell_found(const sim::Engine& engine, LogSink* log,
                              std::vector<sim::Event>& all) const {
  tell_events(engine, results_.events(), log, all);
  for (const RunObserver* const observer : others_) {
    tell_events(engine, observer->events(), log, all);
  }
}

Result<std::string> ObserverList::serve(sim::Engine& engine, const RunRequest& request) {
  if (request.kind == RunRequest::Kind::kResetShadow && shadows_) {
    return shadows_->reset(request.robot);
  }
  auto answer = serve_request(engine, request);
  const bool asks = request.kind == RunRequest::Kind::kList;
  if (answer && !asks) keep(request, engine.steps_done());
  return answer;
}

void ObserverList::keep(const RunRequest& request, std::uint64_t step) {
  if (record_) record_->keep(request, step);
}

std::string ObserverList::end_record(std::optional<std::uint64_t> hash) {
  console_.attach(nullptr);
  if (!record_) return {};
  const Status written = record_->end(hash);
  return written ? std::string() : "the record is not whole: " + written.error().text();
}

}  // namespace rave::runtime
