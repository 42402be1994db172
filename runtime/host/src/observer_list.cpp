// SPDX-License-Identifier: Apache-2.0
#include "rave/host/observer_list.hpp"

#include "rave/assemble/parameter_key.hpp"
#include "rave/control/order_words.hpp"
#include "rave/control/requests.hpp"
#include "rave/recording/provenance.hpp"
#include "rave/recording/world_record.hpp"
#include "rave/results/event_log.hpp"

namespace rave::runtime {
namespace {

bool is_driven(const sim::Engine& engine, const std::string& name) {
  const auto robot = find_robot(engine.spec(), name);
  return robot && engine.order_of(*robot) == "drive";
}

}  // namespace

ObserverList::ObserverList(const Parts& parts)
    : console_(parts.console),
      results_(parts.scenario, parts.robot_kinds, parts.engine.spec(), parts.options.picture) {}

// The console outlives the recording that it writes to.
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
  all_ = {&results_, &leases_};
  if (ros2_) all_.push_back(ros2_.get());
  if (shadows_) all_.push_back(shadows_.get());
  all_.insert(all_.end(), options.observers.begin(), options.observers.end());
  all_.insert(all_.end(), parts.own.begin(), parts.own.end());
  record::RunInfo info = info_of(parts.engine, results_.kinds);
  info.scenario = parts.scenario.scenario.name.value;
  const record::StringMap hybrids = PartKeeper::describe(parts.engine.spec());
  for (RunObserver* const observer : all_) {
    RAVE_TRY(observer->run_begins({parts.engine, results_.kinds, info, hybrids, parts.live}));
  }
  if (!options.record) return {};
  // The recording is opened last, so that a run which an observer refuses leaves none.
  info.expanded_scenario = parts.expanded;
  info.versions = versions_of(parts.engine.spec(), parts.catalogue);
  add_maps(parts.scenario, info);
  add_played_files(parts.engine, info);
  RecordKeeper::About about{hybrids, !parts.live, parts.host};
  if (!parts.host.empty()) {
    RAVE_TRY_ASSIGN(about.hosts, hosts_for_record(parts.scenario));
  }
  RAVE_TRY_ASSIGN(record_, RecordKeeper::open(options.output / "run.mcap", parts.engine,
                                              results_.kinds, info, about, options.log));
  console_.attach(&record_->recorder());
  all_.push_back(record_.get());
  return {};
}

void ObserverList::after_step(const StepView& step) {
  for (RunObserver* const observer : all_) observer->after_step(step);
}

void ObserverList::held(const sim::Engine& engine) {
  for (RunObserver* const observer : all_) observer->held(engine);
}

void ObserverList::after_all(const StepView& step) {
  for (RunObserver* const observer : all_) observer->after_all(step, all_);
}

void ObserverList::tell_found(const sim::Engine& engine, LogSink* log,
                              std::vector<sim::Event>& all) const {
  for (const RunObserver* const observer : all_) tell_events(engine, observer->events(), log, all);
}

Result<std::string> ObserverList::place(const sim::Engine& engine,
                                        const request::Request& request) {
  RAVE_TRY_ASSIGN(const sim::WorldInput input, input_for(engine.spec(), request));
  RAVE_TRY(place_(input));
  return order_answer(request);
}

Result<std::string> ObserverList::make_input(sim::Engine& engine, const request::Request& request,
                                             bool awaited) {
  // It is an input when the authority says so, and is noted then.
  if (forwarder_ != nullptr && InputForwarder::is_for(request.action)) {
    auto answer = forwarder_->give(request);
    const auto given = forwarder_->take_given();
    if (awaited) given_ = given;
    return answer;
  }
  const bool places = request.is<request::Place>() && place_;
  auto answer = places ? place(engine, request) : serve_request(engine, request);
  // A refused request has changed nothing, so a repeated run does not need it.
  if (answer && !request::only_reads(request.action)) keep(request, engine.steps_done());
  return answer;
}

Result<std::string> ObserverList::serve(sim::Engine& engine, const request::Request& request) {
  if (request.is<request::ResetShadow>() && shadows_) {
    return shadows_->reset(request.robot);
  }
  // Chat does not change the run, so it is no input.
  if (request.is<request::Chat>()) {
    if (record_) record_->say(request, engine.steps_done());
    return std::string(record_ ? "added to the recording" : "there is no recording");
  }
  given_.reset();
  return OrderDesk::is_for(request.action) ? serve_order(engine, request)
                                           : make_input(engine, request, true);
}

Result<std::string> ObserverList::serve_order(sim::Engine& engine,
                                              const request::Request& request) {
  if (forwarder_ != nullptr && request.is<request::HandOver>()) {
    return fail(ErrorCode::kState,
                "hosts in lock-step cannot hand a robot over; run it in one process or in real "
                "time");
  }
  if (!request.robot.empty()) RAVE_TRY(find_robot_here(engine, request.robot));
  had_orders_ = true;
  auto answer = desk_.serve(
      request,
      // The desk also ends orders of others, which this request did not ask for.
      [&](const request::Request& asked) { return make_input(engine, asked, &asked == &request); },
      [&](const std::string& robot) {
        return forwarder_ != nullptr ? forwarder_->is_driven(robot) : is_driven(engine, robot);
      },
      OrderDesk::Time::clock::now());
  note_leases(engine);
  return answer;
}

void ObserverList::tick(sim::Engine& engine) {
  if (!desk_.waits()) return;
  desk_.tick([&](const request::Request& asked) { return make_input(engine, asked, false); },
             OrderDesk::Time::clock::now());
  note_leases(engine);
}

void ObserverList::note_leases(const sim::Engine& engine) {
  for (const HostLeases::Change& change : desk_.take_changes()) {
    const auto robot = find_robot(engine.spec(), change.robot);
    if (!robot) continue;
    leases_.add(
        {engine.steps_done(), *robot, sim::EventKind::kLease, BodyId(), lease_text(change)});
    leased_.insert(*robot);
  }
}

void ObserverList::refresh(RunStatus& status) const {
  if (!had_orders_) return;
  for (RunStatus::Robot& robot : status.robots) {
    robot.lease = desk_.holder(robot.name);
    robot.lease_page = desk_.page(robot.name);
  }
}

void ObserverList::keep(const request::Request& request, std::uint64_t step) {
  if (record_) record_->keep(request, step);
}

std::string ObserverList::end_record(std::optional<std::uint64_t> hash) {
  console_.attach(nullptr);
  if (!record_) return {};
  const Status written = record_->end(hash);
  return written ? std::string() : "the recording is incomplete: " + written.error().text();
}

}  // namespace rave::runtime
