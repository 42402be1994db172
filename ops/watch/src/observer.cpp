// SPDX-License-Identifier: Apache-2.0
#include "rave/watch/observer.hpp"

#include <algorithm>
#include <chrono>

#include "rave/bus/wait_set.hpp"
#include "rave/watch/run_model.hpp"

namespace rave::watch {
namespace {

using Clock = std::chrono::steady_clock;

/// Best effort: no writer is asked to send lost samples again. The queue has room for the samples
/// between two looks.
constexpr bus::QosProfile kWatched{.reliable = false, .depth = 64};

std::int64_t ns_of(Clock::time_point when) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(when.time_since_epoch()).count();
}

/// Delay of a sample by the system clocks of both machines.
std::int64_t delay_of(const dds_sample_info_t& info) {
  const auto today = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(today).count() -
         info.source_timestamp;
}

}  // namespace

struct Observer::Impl {
  std::unique_ptr<bus::Bus> bus;
  bus::Reader<bus::HostInfo> infos;
  bus::Reader<bus::RunState> runs;
  bus::Reader<bus::HostRun> words;
  bus::Reader<bus::RosterEntry> roster;
  bus::Reader<bus::ProcessState> processes;
  bus::Reader<bus::HostState> states;
  bus::Reader<bus::World> worlds;
  bus::WaitSet waits;
  RunModel model;

  void take();
};

void Observer::Impl::take() {
  const std::int64_t now_ns = ns_of(Clock::now());
  // Introductions first: they say which host the later messages of a process belong to.
  infos.take([&](const bus::HostInfo& info) { model.hear(info); });
  runs.take([&](const bus::RunState& state) { model.hear(state, now_ns); });
  words.take([&](const bus::HostRun& word) { model.hear_word(word, now_ns); });
  roster.take([&](const bus::RosterEntry& entry) { model.hear(entry); });
  worlds.take([&](const bus::World& world) { model.hear(world, now_ns); });
  states.take([&](const bus::HostState& state, const dds_sample_info_t& info) {
    model.hear(state, now_ns, delay_of(info));
  });
  processes.take([&](const bus::ProcessState& state, const dds_sample_info_t& info) {
    model.hear(state, now_ns, delay_of(info));
  });
  // Last, because a process that has left may have sent something before.
  for (const bus::BusEvent& event : bus->take_events()) {
    if (event.kind == bus::EventKind::kParticipantLost) model.lose(event.writer);
  }
}

Observer::Observer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Observer::~Observer() = default;

Result<std::unique_ptr<Observer>> Observer::open(bus::BusConfig config) {
  // A monitor has no number in the run, so it takes no place and no process waits for it.
  config.anonymous = true;
  RAVE_TRY_ASSIGN(auto bus, bus::Bus::open(config));
  RAVE_TRY_ASSIGN(auto infos, bus::Reader<bus::HostInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto runs, bus::Reader<bus::RunState>::create(*bus));
  RAVE_TRY_ASSIGN(auto words, bus::Reader<bus::HostRun>::create(*bus));
  RAVE_TRY_ASSIGN(auto roster, bus::Reader<bus::RosterEntry>::create(*bus));
  RAVE_TRY_ASSIGN(auto processes, bus::Reader<bus::ProcessState>::create(*bus, kWatched));
  RAVE_TRY_ASSIGN(auto states, bus::Reader<bus::HostState>::create(*bus, kWatched));
  RAVE_TRY_ASSIGN(auto worlds, bus::Reader<bus::World>::create(*bus, kWatched));
  RAVE_TRY_ASSIGN(auto waits, bus::WaitSet::create(*bus));
  RAVE_TRY(waits.add(infos));
  RAVE_TRY(waits.add(runs));
  RAVE_TRY(waits.add(words));
  RAVE_TRY(waits.add(roster));
  RAVE_TRY(waits.add(processes));
  RAVE_TRY(waits.add(states));
  RAVE_TRY(waits.add(worlds));
  RAVE_TRY(waits.add_events());
  RunModel model(config.run.text());
  std::unique_ptr<Impl> impl(new Impl{std::move(bus), std::move(infos), std::move(runs),
                                      std::move(words), std::move(roster), std::move(processes),
                                      std::move(states), std::move(worlds), std::move(waits),
                                      std::move(model)});
  return std::unique_ptr<Observer>(new Observer(std::move(impl)));
}

void Observer::watch(Duration span, const std::stop_token& stop) {
  const auto end = Clock::now() + std::chrono::nanoseconds(span.ns);
  for (;;) {
    impl_->take();
    const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(end - Clock::now());
    if (left.count() <= 0 || stop.stop_requested()) return;
    static_cast<void>(impl_->waits.wait(Duration{left.count()}, stop));
  }
}

RunView Observer::view(bool with_robots) const {
  return impl_->model.view(ns_of(Clock::now()), with_robots);
}

bus::Bus& Observer::bus() noexcept { return *impl_->bus; }
std::vector<KeptAt> Observer::kept() const { return impl_->model.kept(); }
bool Observer::knows_any() const { return impl_->model.knows_any(); }

}  // namespace rave::watch
