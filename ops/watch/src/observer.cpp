// SPDX-License-Identifier: Apache-2.0
#include "rave/watch/observer.hpp"

#include <algorithm>
#include <chrono>

#include "rave/base/wall_clock.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/watch/run_model.hpp"

namespace rave::watch {
namespace {

using Clock = std::chrono::steady_clock;

/// Best effort: no writer is asked to send lost samples again. The queue has room for the samples
/// between two looks.
constexpr bus::QosProfile kWatched{.reliable = false, .depth = 64};

/// Delay of a sample by the system clocks of both machines.
std::int64_t delay_of(const dds_sample_info_t& info) { return wall_ns() - info.source_timestamp; }

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

  explicit Impl(const std::string& run) : model(run) {}
  Status open(const bus::BusConfig& config);
  void take();
};

Status Observer::Impl::open(const bus::BusConfig& config) {
  RAVE_TRY_ASSIGN(bus, bus::Bus::open(config));
  RAVE_TRY(bus::open_all(*bus, infos, runs, words, roster));
  RAVE_TRY(processes.open(*bus, kWatched));
  RAVE_TRY(states.open(*bus, kWatched));
  RAVE_TRY(worlds.open(*bus, kWatched));
  RAVE_TRY_ASSIGN(waits, bus::WaitSet::create(*bus));
  RAVE_TRY(waits.add(infos, runs, words, roster, processes, states, worlds));
  return waits.add_events();
}

void Observer::Impl::take() {
  const std::int64_t now_ns = steady_ns();
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
  auto impl = std::make_unique<Impl>(config.run.text());
  RAVE_TRY(impl->open(config));
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
  RunView view = impl_->model.view(steady_ns(), with_robots);
  if (knows_any()) return view;
  const auto processes = impl_->bus->processes();
  const bool found = std::ranges::any_of(processes, [this](const bus::BusProcess& process) {
    return process.run == impl_->bus->config().run;
  });
  if (found) {
    view.text = "its processes were found, but they send nothing readable: do they use --security?";
  }
  return view;
}

bus::Bus& Observer::bus() noexcept { return *impl_->bus; }
std::vector<KeptAt> Observer::kept() const { return impl_->model.kept(); }
bool Observer::knows_any() const { return impl_->model.knows_any(); }

}  // namespace rave::watch
