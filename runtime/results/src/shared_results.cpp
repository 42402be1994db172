// SPDX-License-Identifier: Apache-2.0
#include "rave/results/shared_results.hpp"

#include <algorithm>
#include <utility>

#include "rave/base/file.hpp"
#include "rave/protocol/agreement.hpp"
#include "rave/recording/world_record.hpp"
#include "rave/results/capture_watch.hpp"
#include "rave/results/facts_file.hpp"
#include "rave/results/outcome.hpp"

namespace rave::runtime {
namespace {

/// The parts of a spec that results use, without the drivers, which cannot be copied.
sim::EngineSpec outline_of(const sim::EngineSpec& spec) {
  sim::EngineSpec outline;
  outline.step = spec.step;
  outline.seed = spec.seed;
  outline.threads = spec.threads;
  outline.world = spec.world;
  outline.robots = spec.robots;
  for (const sim::RobotType& type : spec.types) {
    sim::RobotType& known = outline.types.emplace_back();
    known.name = type.name;
    known.simulated = type.simulated;
    if (!type.communicators.empty()) known.communicators.emplace_back();
  }
  return outline;
}

/// The number of changes of the world that were requested by hand.
std::uint64_t count_by_hand(std::span<const sim::Event> events) {
  return static_cast<std::uint64_t>(std::ranges::count_if(events, [](const sim::Event& event) {
    return (sim::is_of_obstacle(event.kind) || event.kind == sim::EventKind::kChanged) &&
           sim::says_by_hand(event.text);
  }));
}

}  // namespace

struct SharedResults::Impl {
  Impl(const config::ExpandedScenario& s, const BuiltScenario& built, Options o)
      : scenario(s),
        options(std::move(o)),
        spec(outline_of(built.spec)),
        live_reason(built.live_reason),
        kinds(spec, built.robot_kinds) {
    const auto& checks = scenario.scenario.checks;
    // In real time the manager has no exact poses to measure captures with.
    if (live_reason.empty() && checks.capture) capture.emplace(*checks.capture, scenario);
  }

  void note_step(const sim::WorldAuthority& authority);
  void note_take_over(const sim::WorldAuthority& authority, std::uint64_t from);
  /// `steps`: the most that the processes of the host have done.
  Status add(const SharedHost& host, std::string bytes, std::vector<std::string>& added,
             std::uint64_t& steps);
  void fill_in_before(std::uint64_t steps);
  void take(const SharedHost& host, const std::vector<std::size_t>& robots, RunResults& results);
  void note_early(const SharedHost& host, std::uint64_t steps, const RunResults& results);

  const config::ExpandedScenario& scenario;
  Options options;
  sim::EngineSpec spec;
  std::string live_reason;
  BodyKinds kinds;
  std::optional<CaptureWatch> capture;
  Descriptor room;  ///< For the results.
  std::unique_ptr<WorldRecord> record;
  RunFacts facts;
  std::vector<sim::Event> seen;  ///< The captures of the step in progress.
  bool begun = false;
  bool taken_over = false;  ///< From an earlier manager.
  /// A host was absent in some steps, possibly before this manager started.
  bool missed_steps = false;
  std::uint64_t noted = 0;  ///< The number of steps whose events have been taken.
};

/// Records what an earlier manager knew, as a problem of the run.
void SharedResults::Impl::note_take_over(const sim::WorldAuthority& authority, std::uint64_t from) {
  taken_over = true;
  facts.world_from = from;
  const auto told = authority.refused();
  for (const sim::Event& event : told) {
    if (event.step < from) facts.events.push_back(event);
  }
  if (authority.refused_count() <= told.size()) return;
  facts.problems.push_back(
      fmt::format("{} changes of the scenario were refused up to step {}; the first {} are listed",
                  authority.refused_count(), from + 1, told.size()));
}

/// Called with the step that is complete now.
void SharedResults::Impl::note_step(const sim::WorldAuthority& authority) {
  const std::uint64_t done = authority.steps_done();
  kinds.learn(authority.world());
  const bool first = !std::exchange(begun, true);
  // The step that an earlier manager left incomplete was completed here.
  if (first && done > 0) note_take_over(authority, done - 1);
  // At the first world of a run no step is complete yet.
  if (first ? done == 0 : done == noted) return;
  noted = done;
  std::vector<sim::Event> events(authority.events().begin(), authority.events().end());
  events.insert(events.end(), seen.begin(), seen.end());
  seen.clear();
  if (record) record->step(done - 1, kinds, events, authority.hash().value());
  facts.events.insert(facts.events.end(), events.begin(), events.end());
  facts.inputs_by_hand += count_by_hand(authority.events());
}

/// Adds the results of one process of a host; a repeated copy, by whichever way it came, is
/// ignored.
Status SharedResults::Impl::add(const SharedHost& host, std::string bytes,
                                std::vector<std::string>& added, std::uint64_t& steps) {
  if (std::ranges::find(added, bytes) != added.end()) return {};
  RAVE_TRY_ASSIGN(
      RunFacts found,
      decode_facts(std::as_bytes(std::span(bytes)), {shared_number(scenario), host.name},
                   {static_cast<std::uint32_t>(spec.robots.size()), kinds.count()}));
  // A host that joined late lacks its part of the hash.
  missed_steps = missed_steps || found.first_step > 0;
  steps = std::max(steps, found.steps);
  merge(std::move(found), facts);
  added.push_back(std::move(bytes));
  return {};
}

void SharedResults::Impl::take(const SharedHost& host, const std::vector<std::size_t>& robots,
                               RunResults& results) {
  HostShare share{static_cast<const HostState&>(host), {}, false};
  std::vector<std::string> added;
  std::uint64_t steps = 0;
  for (const auto& folder : host.folders) {
    share.folders.push_back(folder.lexically_proximate(options.folder).generic_string());
    auto text = read_file(folder / kFactsFile);
    if (!text && text.error().code == ErrorCode::kNotFound) continue;
    const Status status =
        text ? add(host, *std::move(text), added, steps) : Status(tl::unexpected(text.error()));
    if (status) continue;
    facts.problems.push_back(fmt::format("host `{}`: `{}`: {}", host.name,
                                         (folder / kFactsFile).string(), status.error().message));
  }
  // Results reach the manager in two ways: in a folder on the same machine, and over the bus. Both
  // may have them.
  for (const std::vector<std::byte>& bytes : host.results) {
    const Status status =
        add(host, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, added, steps);
    if (status) continue;
    facts.problems.push_back(
        fmt::format("host `{}`: its results: {}", host.name, status.error().message));
  }
  share.found = !added.empty();
  if (!share.found) {
    results.lost.resize(spec.robots.size());
    for (const std::size_t robot : robots) results.lost[robot] = 1;
    // The results of a remote host stay in its own folder if it could not be asked for them.
    if (!host.folders.empty() || host.awaited) {
      facts.problems.push_back(
          fmt::format("host `{}` {}: nothing is known about its robots here", host.name,
                      host.folders.empty() ? "did not send its results" : "left no results"));
    }
  }
  if (share.found) note_early(host, steps, results);
  results.hosts.push_back(std::move(share));
}

/// In real time the run continues without a host that was ended alone.
void SharedResults::Impl::note_early(const SharedHost& host, std::uint64_t steps,
                                     const RunResults& results) {
  // Of a run that is late, the last steps may be missing; its deadlines say so.
  constexpr double kNear_s = 1;
  const double end_s = static_cast<double>(steps) * spec.step.seconds();
  const config::RunLength planned_s = scenario.scenario.duration_s;
  if (live_reason.empty() || results.ended_by_hand || end_s > planned_s - kNear_s) return;
  facts.problems.push_back(planned_s.is_open()
                               ? fmt::format("host `{}` ended at {:.2f} s", host.name, end_s)
                               : fmt::format("host `{}` ended at {:.2f} s of {:.2f} s", host.name,
                                             end_s, planned_s.seconds));
}

/// If a host saw the whole run, the time before this manager is known as well. `steps` is the
/// number of completed steps.
void SharedResults::Impl::fill_in_before(std::uint64_t steps) {
  if (!taken_over) return;
  const auto from = facts.world_from;
  // At least 1, also for a manager that took over in the first step: perhaps no host saw the whole
  // run.
  facts.world_from = std::max<std::uint64_t>(from, 1);
  if (!facts.world) return;
  WorldFacts told = *std::exchange(facts.world, std::nullopt);
  if (told.first_step > 0 || told.next_step < steps) return;
  using Kind = sim::EventKind;
  // For the step in which it took over, this manager has no texts; for captures, it does not know
  // which ones came before.
  std::erase_if(facts.events, [from](const sim::Event& event) {
    if (event.kind == Kind::kCaptured) return true;
    const bool textless = event.kind == Kind::kChanged && event.text.empty();
    return event.step == from && (textless || event.kind == Kind::kContact ||
                                  event.kind == Kind::kPinned || sim::is_of_obstacle(event.kind));
  });
  std::erase_if(told.events, [from](const sim::Event& event) {
    return event.step > from && event.kind != Kind::kCaptured;
  });
  RunFacts before;
  before.first_step = facts.first_step;
  before.inputs_by_hand = count_by_hand(told.events);
  before.events = std::move(told.events);
  merge(std::move(before), facts);
  facts.capture = std::move(told.capture);
  facts.world_from = 0;
}

SharedResults::SharedResults(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
SharedResults::~SharedResults() = default;

Result<std::unique_ptr<SharedResults>> SharedResults::begin(
    const config::ExpandedScenario& scenario, const BuiltScenario& built, Options options) {
  auto impl = std::make_unique<Impl>(scenario, built, std::move(options));
  impl->room = take_room_for_results(impl->options.folder, impl->spec);
  if (impl->live_reason.empty() && impl->options.record) {
    RAVE_TRY_ASSIGN(impl->record, WorldRecord::begin(impl->options.folder / "world.mcap", scenario,
                                                     impl->spec, impl->kinds, impl->options.log));
  }
  return std::unique_ptr<SharedResults>(new SharedResults(std::move(impl)));
}

bool SharedResults::after_step(const sim::WorldAuthority& authority) {
  impl_->note_step(authority);
  if (!impl_->capture) return false;
  impl_->capture->look(authority.snapshot(), authority.steps_done());
  const auto seen = impl_->capture->events();
  // Written with the next call: the capture belongs to the step that has just begun, and its other
  // events are known only when it is complete.
  impl_->seen.assign(seen.begin(), seen.end());
  return impl_->capture->ends_run();
}

void SharedResults::say(const request::Request& chat) {
  if (impl_->record) impl_->record->say(chat, impl_->noted);
}

void SharedResults::learn(const world::WorldModel& world) {
  impl_->spec.world = world;
  impl_->kinds.learn(world);
}

void SharedResults::at_end(const sim::WorldAuthority& authority) {
  impl_->spec.world = authority.world();
  impl_->facts.has_world = true;
  if (const auto& conductor = authority.spec().conductor) {
    if (auto failure = conductor->failure()) impl_->facts.problems.push_back(*std::move(failure));
  }
  if (impl_->capture) {
    // The step that the last world began was not completed by any host.
    if (impl_->begun) impl_->capture->forget_last_look();
    impl_->facts.capture = impl_->capture->facts();
  }
  if (!impl_->record) return;
  const Status written = impl_->record->end(authority.hash().value());
  if (!written) {
    impl_->facts.problems.push_back("the recording of the world is incomplete: " +
                                    written.error().text());
  }
}

Result<RunOutcome> SharedResults::write(const SharedEnd& end) {
  Impl& impl = *impl_;
  RAVE_TRY_ASSIGN(const auto planned, config::plan_hosts(impl.scenario));
  RunFacts& facts = impl.facts;
  facts.problems.insert(facts.problems.begin(), end.problems.begin(), end.problems.end());
  facts.events.insert(facts.events.end(), end.events.begin(), end.events.end());
  facts.lateness += end.lateness;
  RunResults results{impl.scenario, impl.spec, impl.kinds, impl.live_reason, facts};
  results.ended_by_hand = end.ended_by_hand;
  for (std::size_t h = 0; h < planned.size() && h < end.hosts.size(); ++h) {
    impl.take(end.hosts[h], planned[h].robots, results);
  }
  if (impl.live_reason.empty()) facts.steps = end.steps;
  impl.fill_in_before(facts.steps);
  results.worlds = end.worlds;
  results.states = end.states;
  results.edits = end.edits;
  results.wall_s = end.wall_s;
  if (!impl.missed_steps) results.hash = end.hash;
  impl.room.reset();
  return write_results(results, impl.options.folder, impl.options.picture);
}

}  // namespace rave::runtime
